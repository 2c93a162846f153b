"""Random states of a robot, in the order of each contender."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .robot import Robot

Values = NDArray[np.float64]

COUNT = 256
"""States of a loop: too many to be foreseen, few enough to stay in the nearest cache."""


@dataclass(frozen=True)
class States:
    """Rows of states.

    Attributes:
        position: base position and quaternion (w first), if the robot floats, then joint angles.
        speed: linear and angular velocity of the base in its axes, then joint rates.
        acceleration: the rates of these.
        force: generalised forces, in the order of the speeds.
    """

    position: Values
    speed: Values
    acceleration: Values
    force: Values


def random_states(robot: Robot, count: int = COUNT) -> States:
    """Return states that are the same at every run."""
    draw = np.random.default_rng(7)
    angles = draw.uniform(-1.5, 1.5, (count, len(robot.order)))
    if robot.floats:
        quaternion = draw.normal(size=(count, 4))
        quaternion /= np.linalg.norm(quaternion, axis=1, keepdims=True)
        angles = np.hstack([draw.uniform(-1, 1, (count, 3)), quaternion, angles])
    speed, acceleration, force = (draw.uniform(-1, 1, (count, robot.size)) for _ in range(3))
    return States(angles, speed, acceleration, force)
