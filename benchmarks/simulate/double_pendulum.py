"""A double pendulum in the plane, by the angles of its two massless rods from the vertical."""

from __future__ import annotations

from symbody import (
    Body,
    System,
    Vector,
    functions_of_time,
    ground,
    newton_euler,
    rotate,
    symbols,
    translate,
)

from .problem import Problem

m1, m2, l1, l2, g = symbols("m1 m2 l1 l2 g")
theta1, theta2 = functions_of_time("theta1 theta2")
NUMBERS = {m1: 1.0, m2: 0.7, l1: 1.0, l2: 0.8, g: 9.81}


def double_pendulum(duration: float = 10.0) -> Problem:
    """Return it with swings up to 2.5 rad: large, and not chaotic within ten seconds."""
    knee = rotate("Z", theta1) * translate(0, -l1, 0)
    foot = knee * rotate("Z", theta2 - theta1) * translate(0, -l2, 0)
    system = System(
        bodies=[Body(knee, m1), Body(foot, m2)],
        coordinates=[theta1, theta2],
        gravity=Vector(ground, 0, -g, 0),
    )
    equations = newton_euler(system)
    initial = dict(zip((*equations.coordinates, *equations.speeds), (1.2, -0.5, 0.3, 0.0), strict=True))
    return Problem("double pendulum", equations, NUMBERS, initial, duration)
