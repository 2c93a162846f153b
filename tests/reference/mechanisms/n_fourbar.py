"""IFToMM benchmark A02: N four-bar linkages in a row, N + 1 vertical cranks and N couplers between their tips.

Whenever all bars lie along one line the loops' equations depend on each other, and the mechanism could go on as
another one: each of its parallelograms as an antiparallelogram.
"""

from __future__ import annotations

from math import pi

from symbody import (
    Body,
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


def n_fourbar(N: int = 2) -> Problem:
    """Return N four-bar linkages, by the angle of each bar from the x axis."""
    numbers = reference("n_fourbar")["parameters"]
    m, L, g = symbols("m L g")
    theta = functions_of_time([f"theta{i}" for i in range(N + 1)])
    phi = functions_of_time([f"phi{i}" for i in range(1, N + 1)])
    inertia = m * L**2 / 12

    cranks = [translate(i * L, 0, 0) * rotate("Z", angle) for i, angle in enumerate(theta)]
    tips = [crank * translate(L, 0, 0) for crank in cranks]
    couplers = [tip * rotate("Z", angle - crank) for tip, angle, crank in zip(tips, phi, theta, strict=False)]
    bodies = [Body(Point(bar, L / 2, 0, 0), m, 0, 0, inertia) for bar in (*cranks, *couplers)]
    gaps = [
        project(Point(coupler, L, 0, 0) - origin(tip), ground)
        for coupler, tip in zip(couplers, tips[1:], strict=True)
    ]
    system = System(
        bodies,
        coordinates=(*theta, *phi),
        constraints=[component for gap in gaps for component in gap.components[:2]],
        gravity=Vector(ground, 0, -g, 0),
    )
    speed = -numbers["vx_B0"] / numbers["link_length"]
    B0 = origin(tips[0])
    place, motion = project(B0, ground).coordinates, project(velocity(B0), ground).components
    return Problem(
        newton_euler(system),
        {m: numbers["link_mass"], L: numbers["link_length"], g: numbers["g"]},
        dict.fromkeys(theta, pi / 2)
        | dict.fromkeys(phi, 0.0)
        | {time_derivative(angle): speed for angle in theta}
        | {time_derivative(angle): 0.0 for angle in phi},
        dict(zip(("xB0", "yB0", "vxB0", "vyB0"), (*place[:2], *motion[:2]), strict=True)),
    )
