"""A double pendulum in the plane, by the angles of its two massless rods from the vertical."""

from __future__ import annotations

from symbody import newton_euler
from symbody.models import n_pendulum

from .problem import Problem


def double_pendulum(duration: float = 10.0) -> Problem:
    """Return it with swings up to 2.5 rad: large, and not chaotic within ten seconds."""
    model = n_pendulum(2)
    equations = newton_euler(model.system)
    numbers = {**model.parameters, model["m2"]: 0.7, model["l2"]: 0.8}
    initial = dict(zip((*equations.coordinates, *equations.speeds), (1.2, -0.5, 0.3, 0.0), strict=True))
    return Problem("double pendulum", equations, numbers, initial, duration)
