"""Axes that meet: a frame whose axis of rotation passes through a point at rest may begin there, as in a shoulder.

A displacement along the axis of the rotation that follows is the same one before and behind it. Behind it, the origins
of both rotations are the same point; so no force on the second frame has a moment that the first one must carry.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from typing import final

from symbody.geometry import Frame
from symbody.geometry.motion import Motion, Rotation, Translation
from symbody.geometry.triple import Triple, is_null


def with_meeting_axes(frames: Sequence[Frame], targets: Sequence[Frame]) -> dict[bytes, Frame]:
    """Return, by the keys of frames, frames at the same places with displacements behind rotations.

    Args:
        frames: parents before their children.
        targets: those that carry something, and are needed as they are.
    """
    gathering = _Gathering(frames, targets)
    for frame in frames:
        gathering.add(frame)
    return gathering.moved


@final
class _Gathering:
    """From the root to the leaves."""

    def __init__(self, frames: Sequence[Frame], targets: Sequence[Frame]) -> None:
        self.moved: dict[bytes, Frame] = {}
        self._children = Counter(frame.parent.key for frame in frames if frame.parent is not None)
        self._targets = {frame.key for frame in targets}
        self._turned: dict[bytes, bool] = {}
        self._rests: dict[bytes, bool] = {}
        """Whether anything before or at a frame moves, and whether its origin does not."""

    def add(self, frame: Frame) -> None:
        parent, motion = frame.parent, frame.motion
        if parent is None or motion is None:
            self.moved[frame.key], self._turned[frame.key], self._rests[frame.key] = frame, False, True
            return
        turned = self._turned[parent.key] or not motion.is_constant
        self._turned[frame.key] = turned
        self._rests[frame.key] = self._rests[parent.key] and (is_null(motion.displacement) or not turned)
        base = self.moved[parent.key]
        same = frame if base is parent else base.then(motion).named(frame.name)
        self.moved[frame.key] = self._begun_earlier(frame) or same

    def _begun_earlier(self, frame: Frame) -> Frame | None:
        """Return the frame with the displacement before its rotation put behind, if that leads to a point at rest."""
        rotation, run = frame.motion, list[Motion]()
        if not isinstance(rotation, Rotation) or rotation.is_constant:
            return None
        before = frame.parent
        while before is not None and isinstance(before.motion, Rotation) and self._is_between(before):
            run.append(before.motion)
            before = before.parent
        if before is None or not isinstance(before.motion, Translation) or not self._is_between(before):
            return None
        start, d = before.parent, before.motion.displacement
        assert start is not None, "a motion has a parent"
        run.reverse()
        for turn in run:
            d = turn.to_child(d)
        if not (self._turned[start.key] and self._rests[start.key] and _is_along(d, rotation.axis)):
            return None
        result = self.moved[start.key]
        for motion in (*run, rotation, Translation(d)):
            result = result.then(motion)
        return result.named(frame.name) if result.depth == frame.depth else None

    def _is_between(self, frame: Frame) -> bool:
        """Tell whether a fixed frame is there for the next one alone."""
        assert frame.motion is not None, "only the root has no motion"
        alone = self._children[frame.key] == 1 and frame.key not in self._targets
        return alone and frame.motion.is_constant


def _is_along(d: Triple, axis: int) -> bool:
    return all(component.is_zero for k, component in enumerate(d) if k != axis)
