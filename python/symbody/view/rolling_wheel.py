"""Wheels that roll on a plane, drawn with the radius at which they touch it."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, NamedTuple

import numpy as np

from symbody.multibody.joint.rolling import Contact

from .drawable_motion import DrawableMotion, mechanism_of
from .frame_table import FrameTable
from .pose import constants

__all__ = ["RollingWheel", "rolling_wheels"]

_AXIS = np.array([0.0, 1.0, 0.0])
"""The axis of a wheel, in the axes of its joint."""


class RollingWheel(NamedTuple):
    """A disc, or a ball.

    Attributes:
        body: the name of the wheel.
        pose: the place of the frame in its centre.
        circle: the radius of the circle of centres of cross-sections; zero for a ball.
        crown: the radius of the cross-section; zero for a disc with a sharp edge.
    """

    body: str
    pose: int
    circle: float
    crown: float

    def part(self, thickness: float) -> dict[str, Any]:
        """Return the wheel as a part of a body, whose size is not found by inertia."""
        radius = self.circle + self.crown
        if self.circle <= 0:
            return {
                "pose": self.pose,
                "kind": "ellipsoid",
                "size": [radius] * 3,
                "at": [0.0] * 3,
                "is_true": True,
            }
        half = max(thickness / 2, self.crown) * _AXIS
        return {
            "pose": self.pose,
            "kind": "rod",
            "radius": radius,
            "from": (-half).tolist(),
            "to": half.tolist(),
            "is_true": True,
        }


def rolling_wheels(motion: DrawableMotion, table: FrameTable) -> Iterator[RollingWheel]:
    """Yield the wheels of a mechanism that are links."""
    for joint in getattr(mechanism_of(motion), "joints", ()):
        pair, (_, (name, side)) = joint.joint.pair, joint.ends
        if name and isinstance(pair, Contact):
            circle, crown = constants(motion, [pair.circle, pair.crown])
            yield RollingWheel(name, table.place(side), float(circle), float(crown))
