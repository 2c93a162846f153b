"""IFToMM benchmark A02: N four-bar linkages in a row, N + 1 vertical cranks and N couplers between their tips.

Whenever all bars lie along one line the loops' equations depend on each other, and the mechanism could go on as
another one: each of its parallelograms as an antiparallelogram.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import pi

from symbody import (
    Body,
    Expr,
    Frame,
    Point,
    System,
    Vector,
    functions_of_time,
    ground,
    newton_euler,
    origin,
    project,
    rotate,
    symbols,
    time_derivative,
    translate,
    velocity,
)

from .problem import Problem, reference

m, L, g = symbols("m L g")


@dataclass(frozen=True)
class Linkages:
    """Four-bar linkages in a row.

    Attributes:
        system: what moves.
        theta: the angles of the cranks from the x axis.
        phi: the angles of the couplers from the x axis, or from their cranks.
        tips: frames at the ends of the cranks.
    """

    system: System
    theta: list[Expr]
    phi: list[Expr]
    tips: list[Frame]


def linkages(N: int, distance: Expr = L, *, is_relative: bool = False) -> Linkages:
    """Return N four-bar linkages whose cranks of length L stand at a distance that is the length of the couplers.

    Args:
        N: how many there are.
        distance: from crank to crank.
        is_relative: whether the couplers' angles are counted from their cranks.
    """
    theta = functions_of_time([f"theta{i}" for i in range(N + 1)])
    phi = functions_of_time([f"phi{i}" for i in range(1, N + 1)])
    cranks = [translate(i * distance, 0, 0) * rotate("Z", angle) for i, angle in enumerate(theta)]
    tips = [crank * translate(L, 0, 0) for crank in cranks]
    turned = [b if is_relative else b - a for a, b in zip(theta, phi, strict=False)]
    couplers = [tip * rotate("Z", angle) for tip, angle in zip(tips, turned, strict=False)]
    gaps = [
        project(Point(coupler, distance, 0, 0) - origin(tip), ground)
        for coupler, tip in zip(couplers, tips[1:], strict=True)
    ]
    system = System(
        [*(bar_of(crank, m, L) for crank in cranks), *(bar_of(coupler, m, distance) for coupler in couplers)],
        coordinates=(*theta, *phi),
        constraints=[component for gap in gaps for component in gap.components[:2]],
        gravity=Vector(ground, 0, -g, 0),
    )
    return Linkages(system, theta, phi, tips)


def bar_of(frame: Frame, mass: Expr, length: Expr) -> Body:
    """Return a slender bar along the x axis of a frame, from its origin."""
    return Body(Point(frame, length / 2, 0, 0), mass, 0, 0, mass * length**2 / 12)


def n_fourbar(N: int = 2) -> Problem:
    """Return N four-bar linkages, by the angle of each bar from the x axis."""
    numbers = reference("n_fourbar")["parameters"]
    row = linkages(N)
    theta, phi = row.theta, row.phi
    speed = -numbers["vx_B0"] / numbers["link_length"]
    B0 = origin(row.tips[0])
    place, motion = project(B0, ground).coordinates, project(velocity(B0), ground).components
    return Problem(
        newton_euler(row.system),
        {m: numbers["link_mass"], L: numbers["link_length"], g: numbers["g"]},
        dict.fromkeys(theta, pi / 2)
        | dict.fromkeys(phi, 0.0)
        | {time_derivative(angle): speed for angle in theta}
        | {time_derivative(angle): 0.0 for angle in phi},
        dict(zip(("xB0", "yB0", "vxB0", "vyB0"), (*place[:2], *motion[:2]), strict=True)),
    )
