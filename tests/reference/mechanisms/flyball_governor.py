"""IFToMM benchmark A05: a flyball governor whose arms hang on the slider by very stiff springs with dampers.

The shaft turns by psi about the vertical z axis; two rods with a ball at the end each hang alpha below the horizontal
on hinges beside the top of the shaft; the slider is at the height s. All has the shape of boxes.
"""

from __future__ import annotations

from math import radians

from symbody import (
    Body,
    Expr,
    Force,
    Frame,
    Point,
    System,
    Vector,
    dot,
    functions_of_time,
    ground,
    lagrange_equations,
    origin,
    pi,
    project,
    rotate,
    sqrt,
    symbols,
    time_derivative,
    translate,
)

from .problem import Problem, reference

rho, m, g, k, c, l0, L, b, h, offset, top = PARAMETERS = symbols("rho m g k c l_0 L b h a z_A")


def flyball_governor() -> Problem:
    numbers = reference("flyball_governor")
    given, run = numbers["parameters"], numbers["results"]["IFToMM"]
    psi, alpha, s = coordinates = functions_of_time("psi alpha s")
    shaft_frame = rotate("Z", psi)
    slider_frame = shaft_frame * translate(0, 0, s)
    shaft = box(shaft_frame * translate(0, 0, top / 2), b, b, L, name="shaft")
    slider = box(slider_frame, h, h, h, name="slider")
    bodies, loads = [shaft, slider], []
    for side, turn in (("right", 0), ("left", pi)):
        arm = shaft_frame * rotate("Z", turn) * translate(offset, 0, top) * rotate("Y", alpha)
        rod = box(arm * translate(L / 2, 0, 0), L, b, b, name=f"{side} rod")
        ball = Body(arm * translate(L, 0, 0), m, name=f"{side} ball")
        face = Point(slider_frame * rotate("Z", turn), offset, 0, 0)
        bodies += [rod, ball]
        loads.append(spring(face, slider, rod))
    system = System(bodies, loads, coordinates, gravity=Vector(ground, 0, 0, -g))
    values = [
        *(given["density"], given["point_mass"], given["g"], run["k"], run["c"], given["rest_length"]),
        *(*given["shaft_rod_dims"][:2], given["slider_dims"][0], given["A"][0], given["A"][2]),
    ]
    start = {psi: 0.0, alpha: radians(given["alpha0_deg"]), s: given["s0"]}
    rates = {time_derivative(psi): run["omega0"], time_derivative(alpha): 0.0, time_derivative(s): 0.0}
    return Problem(lagrange_equations(system), dict(zip(PARAMETERS, values, strict=True)), start | rates)


def box(center: Frame, x: Expr, y: Expr, z: Expr, name: str) -> Body:
    """Return a homogeneous box."""
    mass = rho * x * y * z
    moments = (mass * (p**2 + q**2) / 12 for p, q in ((y, z), (x, z), (x, y)))
    return Body(origin(center), mass, *moments, name=name)


def spring(face: Point, slider: Body, rod: Body) -> Force:
    """Return the spring and damper between the slider's face and the middle of a rod."""
    middle = rod.center_of_mass
    along = project(middle - face, ground)
    length = sqrt(dot(along, along))
    pull = k * (length - l0) + c * time_derivative(length)
    return Force(-pull / length * along, at=middle, on=rod, reaction=slider)
