"""The Franka Panda arm of the reference results, which falls freely: seven joints, gravity, no friction."""

from __future__ import annotations

import numpy as np

from symbody import Equations, newton_euler

from ..evaluate.robot import Robot, from_reference, system
from .problem import Array, Problem

SPREAD = 0.5
"""How far the initial angles are from zero, in rad."""


def arm() -> Robot:
    """Return the arm: the numbers of its links and joints."""
    return from_reference("panda_7dof", "panda")


def panda(duration: float = 1.0) -> Problem:
    """Return the arm, released from rest."""
    equations: Equations = newton_euler(system(arm()))
    initial = dict.fromkeys((*equations.coordinates, *equations.speeds), 0.0)
    return Problem("panda", equations, {}, initial, duration)


def starts(count: int) -> Array:
    """Return initial states at rest, at random angles."""
    angles = np.random.default_rng(5).uniform(-SPREAD, SPREAD, (count, 7))
    return np.hstack([angles, np.zeros((count, 7))])
