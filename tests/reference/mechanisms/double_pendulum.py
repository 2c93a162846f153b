"""A planar double pendulum, by its two angles from the vertical and by natural coordinates."""

from __future__ import annotations

from symbody import (
    Body,
    Equations,
    Expr,
    Point,
    System,
    Vector,
    cos,
    functions_of_time,
    ground,
    lagrange_equations,
    newton_euler,
    rotate,
    sin,
    symbols,
    time_derivative,
    translate,
)

from .problem import Problem, reference

m1, m2, l1, l2, g = symbols("m1 m2 l1 l2 g")
x1, y1, x2, y2 = NATURAL = functions_of_time("x1 y1 x2 y2")
theta1, theta2 = ANGLES = functions_of_time("theta1 theta2")
GRAVITY = Vector(ground, 0, -g, 0)
REFERENCE = reference("double_pendulum_natural")
PARAMETERS = {symbol: REFERENCE["parameters"][symbol.name] for symbol in (m1, m2, l1, l2, g)}


def natural() -> System:
    constraints = [x1**2 + y1**2 - l1**2, (x2 - x1) ** 2 + (y2 - y1) ** 2 - l2**2]
    bodies = [Body(Point(ground, x1, y1, 0), m1), Body(Point(ground, x2, y2, 0), m2)]
    return System(bodies=bodies, coordinates=NATURAL, constraints=constraints, gravity=GRAVITY)


def minimal() -> System:
    """Return the same pendulum with both angles measured from the vertical."""
    knee = rotate("Z", theta1) * translate(0, -l1, 0)
    foot = knee * rotate("Z", theta2 - theta1) * translate(0, -l2, 0)
    return System(bodies=[Body(knee, m1), Body(foot, m2)], coordinates=ANGLES, gravity=GRAVITY)


def double_pendulum() -> Problem:
    x, y = l1 * sin(theta1), -l1 * cos(theta1)
    places = (x, y, x + l2 * sin(theta2), y - l2 * cos(theta2))
    start = REFERENCE["initial"]
    return _problem(newton_euler(minimal()), (*start["theta"], *start["thetad"]), places)


def natural_double_pendulum() -> Problem:
    start = REFERENCE["rows"][0]
    return _problem(lagrange_equations(natural()), (*start["xy"], *start["v"]), NATURAL)


def _problem(equations: Equations, start: tuple[float, ...], places: tuple[Expr, ...]) -> Problem:
    named = dict(zip(("x1", "y1", "x2", "y2"), places, strict=True))
    named |= {f"v_{name}": time_derivative(place) for name, place in named.items()}
    state = dict(zip((*equations.coordinates, *equations.speeds), start, strict=True))
    return Problem(equations, PARAMETERS, state, named)
