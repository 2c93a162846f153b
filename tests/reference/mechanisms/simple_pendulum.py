"""IFToMM benchmark A01: a point mass on a massless rod, by the rod's angle and by natural coordinates."""

from __future__ import annotations

from math import pi

from symbody import (
    Body,
    Point,
    System,
    Vector,
    cos,
    functions_of_time,
    ground,
    lagrange_equations,
    rotate,
    sin,
    symbols,
    time_derivative,
    translate,
)

from .problem import Problem, reference

m, L, g = symbols("m L g")
theta, x, y = functions_of_time("theta x y")
GRAVITY = Vector(ground, 0, -g, 0)
PARAMETERS = {symbol: float(reference("simple_pendulum")["parameters"][symbol.name]) for symbol in (m, L, g)}


def rod() -> System:
    """Return the pendulum with its angle from the horizontal, counter-clockwise, as the coordinate."""
    return System([Body(rotate("Z", theta) * translate(L, 0, 0), m)], coordinates=[theta], gravity=GRAVITY)


def mass_on_a_circle() -> System:
    """Return the pendulum with the position of the mass as the coordinates."""
    mass = Body(Point(ground, x, y, 0), m)
    return System([mass], coordinates=[x, y], constraints=[x**2 + y**2 - L**2], gravity=GRAVITY)


def simple_pendulum() -> Problem:
    speed = time_derivative(theta)
    named = {"x": L * cos(theta), "y": L * sin(theta), "theta_dot": speed}
    return Problem(lagrange_equations(rod()), PARAMETERS, {theta: pi, speed: 0.0}, named)


def natural_simple_pendulum() -> Problem:
    vx, vy = map(time_derivative, (x, y))
    named = {"x": x, "y": y, "theta_dot": (x * vy - y * vx) / L**2}
    return Problem(
        lagrange_equations(mass_on_a_circle()), PARAMETERS, {x: -1.0, y: 0.0, vx: 0.0, vy: 0.0}, named
    )
