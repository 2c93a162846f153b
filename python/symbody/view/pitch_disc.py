"""Gears and pinions, drawn as discs in their pitch circles."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, NamedTuple

import numpy as np

from symbody.multibody.joint.closure import AXES
from symbody.multibody.joint.pair import SlideAndTurn

from .drawable_motion import DrawableMotion, mechanism_of
from .frame_table import FrameTable
from .pose import values

__all__ = ["PitchDisc", "pitch_discs"]


class PitchDisc(NamedTuple):
    """A disc about the axis of a wheel, through the point at which its teeth touch those of another wheel or a rack.

    Attributes:
        body: the name of the wheel.
        pose: the place of its frame.
        axis: 0, 1 or 2, in this frame.
        height: of the disc along the axis, from the origin of the frame.
        radius: of the pitch circle.
    """

    body: str
    pose: int
    axis: int
    height: float
    radius: float

    def part(self, thickness: float) -> dict[str, Any]:
        """Return the disc as a part of a body, whose size is not found by inertia."""
        along = np.eye(3)[self.axis]
        ends = [(self.height + side * thickness / 2) * along for side in (-1, 1)]
        return {
            "pose": self.pose,
            "kind": "rod",
            "radius": self.radius,
            "from": ends[0].tolist(),
            "to": ends[1].tolist(),
            "is_true": True,
        }


def pitch_discs(motion: DrawableMotion, table: FrameTable) -> Iterator[PitchDisc]:
    """Yield the discs of the wheels of a mechanism; a wheel that meshes at several radii has several."""
    placed = getattr(mechanism_of(motion), "joints", ())
    for mesh in (joint for joint in placed if joint.joint.pair.coupled):
        for joint in (each for each in placed if each.joint in mesh.joint.pair.coupled):
            pair, (_, (name, side)) = joint.joint.pair, joint.ends
            if name and isinstance(pair, SlideAndTurn) and len(pair.turns) == 1:
                axis = AXES.index(pair.turns)
                at = values(motion, mesh.acting_point.projected(side).coordinates)[:, 0]
                radius = float(np.linalg.norm(np.delete(at, axis)))
                yield PitchDisc(name, table.place(side), axis, float(at[axis]), radius)
