"""Shifted origins: where frames begin on their axes of rotation.

A displacement along the axis of the rotation that follows may be put behind this rotation. Two axes may then meet in a
point at rest, as in a shoulder, so that forces at this point have no moment about the first axis. If all inertias are
numbers, the displacement may also be added to the displacement that follows, or to the places of the last bodies.
With symbols, it is added if all that follows are displacements with a component along the axis: each of them keeps its
number of components, and the one before the rotation loses one.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from typing import NamedTuple, final

from symbody.geometry import Frame, Triple
from symbody.geometry.component.triple import is_null
from symbody.geometry.motion.frame_motion import FrameMotion
from symbody.geometry.motion.principal_rotation import along
from symbody.geometry.motion.translation import Translation
from symbody.symbolic import add3, cross3, dot3, number, sub3


def with_shifted_origins(
    frames: Sequence[Frame], needed: Sequence[Frame], *, numeric: bool
) -> dict[bytes, Frame]:
    """Return frames at the same places with displacements behind rotations, by the keys of the given frames.

    Args:
        frames: parents before their children.
        needed: those of them that carry more than bodies with numeric inertia.
        numeric: whether the masses and inertias of all bodies are numbers.
    """
    shifting = _Shifting(frames, needed, numeric=numeric)
    for frame in frames:
        shifting.add(frame)
    return shifting.moved


class _Run(NamedTuple):
    """The motions before a rotation: a displacement of a frame, and rotations by numbers."""

    start: Frame
    displacement: Triple
    turns: tuple[FrameMotion, ...]


@final
class _Shifting:
    """The recursion from the root to the leaves."""

    def __init__(self, frames: Sequence[Frame], needed: Sequence[Frame], *, numeric: bool) -> None:
        self.moved: dict[bytes, Frame] = {}
        self._numeric = numeric
        self._needed = {frame.key for frame in needed}
        self._forks, self._following = _forks(frames, self._needed)
        self._children = _children(frames)
        self._loose: set[bytes] = set()
        """Frames that end with a displacement put behind a rotation."""
        self._adding: set[bytes] = set()
        """Those of them whose displacement is added to all that follow."""
        self._turned: dict[bytes, bool] = {}
        self._rests: dict[bytes, bool] = {}
        """Whether anything before or at a frame moves, and whether its origin does not."""

    def add(self, frame: Frame) -> None:
        parent, motion = frame.parent, frame.motion
        if parent is None or motion is None:
            self._turned[frame.key], self._rests[frame.key] = frame.carrier is not None, frame.carrier is None
            self.moved[frame.key] = frame
            return
        base = self.moved[parent.key]
        result = self._shifted(frame)
        if result is None and base.key in self._loose and not motion.rotates:
            result = self._joined(base, motion)
        if result is None:
            result = self._then(base, motion) if base is not parent else self._seen(frame, base, motion)
        self.moved[frame.key] = result if result.name == frame.name else result.named(frame.name)

    def _shifted(self, frame: Frame) -> Frame | None:
        """Return the frame with the displacement along its axis put behind the rotation; None if that gains nothing."""
        rotation = frame.motion
        if rotation is None or rotation.turn_axis is None or rotation.is_constant:
            return None
        run = self._run(frame)
        if run is None:
            return None
        d, k = run.displacement, rotation.turn_axis
        for turn in run.turns:
            d = turn.to_child(d)
        if d[k].is_zero or not self._turned[run.start.key]:
            return None
        behind = along(k, d[k])
        before = sub3(d, behind)
        meets = is_null(before) and self._rests[run.start.key]
        folds = self._numeric and _is_numeric(run.displacement) and self._is_absorbed(frame, k)
        adds = self._is_added(frame, k)
        if not (meets or folds or adds):
            return None
        for turn in reversed(run.turns):
            before = turn.to_parent(before)
        chain = (*run.turns, rotation, Translation(behind))
        result = self._chained(run.start, chain if is_null(before) else (Translation(before), *chain))
        if adds and result is not None:
            self._adding.add(result.key)
        return result

    def _chained(self, start: Frame, motions: Sequence[FrameMotion]) -> Frame | None:
        """Return the frame reached by motions; None if some of them merge, which would hide a coordinate."""
        result = start
        for motion in motions:
            result = self._then(result, motion)
        if result.depth != start.depth + len(motions):
            return None
        self._loose.add(result.key)
        return result

    def _joined(self, base: Frame, motion: FrameMotion) -> Frame | None:
        if base.parent is None or base.motion is None:
            return None
        d, beyond = base.motion.displacement, motion.displacement
        numeric = self._numeric and _is_numeric(d) and _is_numeric(beyond)
        if not numeric and base.key not in self._adding:
            return None
        total = add3(d, beyond)
        return base.parent if is_null(total) else self._then(base.parent, Translation(total))

    def _run(self, frame: Frame) -> _Run | None:
        """Return the motions before a rotation that lead to nothing but this rotation."""
        turns = list[FrameMotion]()
        before = frame.parent
        while before is not None and (turn := _fixed_turn(before)) is not None:
            if not self._is_alone(before):
                return None
            turns.append(turn)
            before = before.parent
        if before is None or not self._is_alone(before):
            return None
        place = self.moved[before.key]
        if (
            place.parent is None
            or place.motion is None
            or place.motion.rotates
            or not place.motion.is_constant
        ):
            return None
        return _Run(place.parent, place.motion.displacement, tuple(reversed(turns)))

    def _is_absorbed(self, frame: Frame, axis: int) -> bool:
        """Return whether a displacement along an axis of a frame joins one that follows, or only bodies follow."""
        e = along(axis, number(1))
        while self._forks[frame.key]:
            if not self._is_alone(frame):
                return False
            frame = self._following[frame.key]
            motion = frame.motion
            if motion is None:
                return False
            if not motion.rotates:
                if not _is_numeric(motion.displacement):
                    return False
                if not dot3(e, motion.displacement).is_zero:
                    return True
            elif _keeps(motion, e):
                e = motion.to_child(e)
            else:
                return False
        return True

    def _is_added(self, frame: Frame, axis: int) -> bool:
        """Return whether displacements along an axis follow a frame at once, wherever they lead."""
        following = self._children.get(frame.key, ())
        return (
            frame.key not in self._needed
            and bool(following)
            and all(not motion.rotates and not motion.displacement[axis].is_zero for motion in following)
        )

    def _is_alone(self, frame: Frame) -> bool:
        return self._forks[frame.key] == 1 and frame.key not in self._needed

    def _then(self, base: Frame, motion: FrameMotion) -> Frame:
        return self._seen(base.then(motion), base, motion)

    def _seen(self, frame: Frame, base: Frame, motion: FrameMotion) -> Frame:
        turned = self._turned[base.key] or not motion.is_constant
        self._turned[frame.key] = turned
        self._rests[frame.key] = self._rests[base.key] and (is_null(motion.displacement) or not turned)
        return frame


def _forks(frames: Sequence[Frame], needed: set[bytes]) -> tuple[Counter[bytes], dict[bytes, Frame]]:
    """Return, by frame, how many of its children lead to motions or to needed frames, and one of these children."""
    forks, following = Counter[bytes](), dict[bytes, Frame]()
    for frame in reversed(frames):
        if frame.parent is None or frame.motion is None:
            continue
        if frame.key in needed or not frame.motion.is_constant or forks[frame.key]:
            forks[frame.parent.key] += 1
            following[frame.parent.key] = frame
    return forks, following


def _children(frames: Sequence[Frame]) -> dict[bytes, list[FrameMotion]]:
    """Return, by frame, the motions that lead on from it."""
    result: dict[bytes, list[FrameMotion]] = {}
    for frame in frames:
        if frame.parent is not None and frame.motion is not None:
            result.setdefault(frame.parent.key, []).append(frame.motion)
    return result


def _fixed_turn(frame: Frame) -> FrameMotion | None:
    """Return the motion of a frame if it is a rotation about a principal axis by a number."""
    motion = frame.motion
    return motion if motion is not None and motion.turn_axis is not None and motion.is_constant else None


def _keeps(motion: FrameMotion, e: Triple) -> bool:
    """Return whether an axis that is fixed in the parent is fixed in the child of a rotation about a principal axis."""
    k = motion.turn_axis
    return k is not None and (motion.is_constant or is_null(cross3(along(k, number(1)), e)))


def _is_numeric(displacement: Triple) -> bool:
    return all(component.is_constant for component in displacement)
