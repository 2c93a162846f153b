"""The slider-crank of SUNDIALS' example idaSlCrank: a crank, and a rod whose centre slides on the x axis.

A spring with a damper joins the middle of the crank and the middle of the rod's nearer half; a force F along x acts
on the rod's far end.
"""

from __future__ import annotations

from math import asin, cos, pi

from symbody import (
    Body,
    Force,
    Point,
    System,
    dot,
    functions_of_time,
    ground,
    lagrange_equations,
    project,
    rotate,
    sqrt,
    symbols,
    time_derivative,
    translate,
)

from .problem import Problem, reference


def slider_crank() -> Problem:
    numbers = reference("slider_crank")["parameters"]
    a, J1, m2, J2, k, c, l0, F = parameters = symbols("a J1 m2 J2 k c l0 F")
    q, x, p = coordinates = functions_of_time("q x p")
    crank_frame = rotate("Z", q)
    rod_frame = translate(x, 0, 0) * rotate("Z", p)
    crank, rod = Body(crank_frame, 0, 0, 0, J1, name="crank"), Body(rod_frame, m2, 0, 0, J2, name="rod")

    gap = project(Point(rod_frame, -1, 0, 0) - Point(crank_frame, a, 0, 0), ground)
    end = Point(rod_frame, -1 / 2, 0, 0)
    along = project(end - Point(crank_frame, a / 2, 0, 0), ground)
    length = sqrt(dot(along, along))
    pull = k * (length - l0) + c * time_derivative(length)
    loads = [
        # Its forces at both ends are along the line through them: to act and react at one of them is the same.
        Force(-pull / length * along, at=end, on=rod, reaction=crank, name="spring"),
        Force(ground, F, 0, 0, at=Point(rod_frame, 1, 0, 0), on=rod, name="push"),
    ]
    system = System([crank, rod], loads, coordinates, gap.components[:2])
    angle = asin(-numbers["a"])
    return Problem(
        lagrange_equations(system),
        {symbol: numbers[symbol.name] for symbol in parameters},
        {q: pi / 2, x: cos(angle), p: angle} | {time_derivative(each): 0.0 for each in coordinates},
    )
