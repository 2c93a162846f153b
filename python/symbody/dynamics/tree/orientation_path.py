"""Orientation paths: how a frame is turned and displaced, whatever motions a user wrote for it.

Motions that turn about one axis without other rotations between them add up, even if displacements are between them:
after ``rotate("Z", q1) * translate(0, l, 0) * rotate("Z", q2 - q1)`` a frame is turned by q2. An orientation is thus a
word of rotations, in which neighbours have different axes, and a frame is placed by displacements in the axes of such
words. Angles about one axis in one parent are arranged in a tree, in which every angle follows the one from which it
differs by the fewest coordinates: q1 + q2 follows q1, and q2 follows none.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import NamedTuple, TypeAlias

from symbody.geometry import Frame
from symbody.geometry.component.triple import NULL, Triple, is_null
from symbody.geometry.frame.frame import frames_without_state
from symbody.geometry.motion.frame_motion import FrameMotion
from symbody.geometry.motion.principal_rotation import Rotation
from symbody.symbolic import Expr, add3, number


class Turn(NamedTuple):
    """A rotation about a principal axis."""

    axis: int
    angle: Expr


Word: TypeAlias = tuple[Turn, ...]
"""The rotations from the root to an orientation; neighbours have different axes."""


class Placed(NamedTuple):
    """A frame by its orientation, and its displacements in the axes of orientations, on a base."""

    frame: Frame
    base: Frame
    word: Word
    displacements: tuple[tuple[Word, Triple], ...]


def placed(frames: Iterable[Frame]) -> list[Placed]:
    """Return how frames are placed by rotations about principal axes and displacements.

    They begin at the base of a frame: the last frame before it that is placed by another motion, such as a moving
    master frame, or the root.
    """
    known: dict[bytes, Placed] = {}
    result = []
    for frame in frames:
        for link in frames_without_state(frame, known):
            known[link.key] = (
                _beyond(known[link.parent.key], link) if link.parent else Placed(link, link, (), ())
            )
        result.append(known[frame.key]._replace(frame=frame))
    return result


def _beyond(before: Placed, frame: Frame) -> Placed:
    """Return how a frame is placed, by its motion from its parent and how that one is placed."""
    _, base, word, displacements = before
    motion = frame.motion
    turn = None if motion is None else turn_of(motion)
    if turn is not None:
        return Placed(frame, base, joined(word, (turn,)), displacements)
    if motion is None or motion.rotates or motion.twist is not None:
        return Placed(frame, frame, (), ())
    return Placed(frame, base, word, (*displacements, (word, motion.displacement)))


def turn_of(motion: FrameMotion) -> Turn | None:
    """Return the rotation about a principal axis that a motion is, if it is nothing else."""
    if motion.turn_axis is None or motion.turn_angle is None:
        return None
    return Turn(motion.turn_axis, motion.turn_angle)


def _turn(word: list[Turn], turn: Turn) -> None:
    if not word or word[-1].axis != turn.axis:
        word.append(turn)
        return
    angle = word.pop().angle + turn.angle
    if not angle.is_zero:
        word.append(Turn(turn.axis, angle))


def joined(word: Word, turns: Iterable[Turn]) -> Word:
    """Return the orientation to which rotations lead from another one."""
    result = list(word)
    for turn in turns:
        _turn(result, turn)
    return tuple(result)


def between(first: Word, second: Word) -> Word:
    """Return the rotations that lead from one orientation to another."""
    turns = list[Turn]()
    for axis, angle in reversed(first):
        _turn(turns, Turn(axis, -angle))
    for turn in second:
        _turn(turns, turn)
    return tuple(turns)


Step: TypeAlias = tuple[Word, Turn]
"""A node of the tree of orientations, and the rotation that leads to it."""


class OrientationTree:
    """The orientations of some frames: for each, the rotations from the root through other orientations.

    Attributes:
        words: the orientations but that of the root.
    """

    def __init__(self, words: Iterable[Word]) -> None:
        self._before: dict[tuple[Word, int], dict[Expr, Expr]] = {}
        """By word and axis: for each angle about it, the angle that it follows."""
        families: dict[tuple[Word, int], dict[Expr, None]] = {}
        self.words = tuple(dict.fromkeys(word for word in words if word))
        for word in self.words:
            for k, turn in enumerate(word):
                families.setdefault((word[:k], turn.axis), {})[turn.angle] = None
        for family, angles in families.items():
            self._before[family] = _followed(list(angles))

    def path(self, word: Word) -> list[Step]:
        """Return the orientations on the way to one, each with the rotation that leads there."""
        steps = list[Step]()
        for k, turn in enumerate(word):
            before, angle, ways = self._before[word[:k], turn.axis], turn.angle, list[Step]()
            while not angle.is_zero:
                previous = before[angle]
                ways.append(((*word[:k], Turn(turn.axis, angle)), Turn(turn.axis, angle - previous)))
                angle = previous
            steps.extend(reversed(ways))
        return steps


def _followed(angles: Sequence[Expr]) -> dict[Expr, Expr]:
    zero = number(0)
    result: dict[Expr, Expr] = {}
    for angle in sorted(angles, key=variables):
        best, fewest = zero, variables(angle)
        for other in result:
            if (
                len(_coordinates(angle) ^ _coordinates(other)) < fewest
            ):  # their difference depends on these at least
                difference = variables(angle - other)
                if difference < fewest:
                    best, fewest = other, difference
        result[angle] = best
    return result


def variables(angle: Expr) -> int:
    """Return how many coordinates an angle depends on."""
    return len(_coordinates(angle))


def _coordinates(angle: Expr) -> set[Expr]:
    return {leaf for leaf in angle.free_symbols if leaf.depends_on_time}


def carried_back(d: Triple, steps: Sequence[Step]) -> Triple:
    """Return a displacement in the axes before some rotations, given in those behind them."""
    turns = list[Turn]()
    for _, turn in steps:
        _turn(turns, turn)
    for turn in reversed(turns):
        d = Rotation(turn.axis, turn.angle).to_parent(d)
    return d


def common(path: Sequence[Step], other: Sequence[Step]) -> int:
    """Return how many orientations two paths share."""
    count = 0
    for a, b in zip(path, other, strict=False):
        if a[0] != b[0]:
            break
        count += 1
    return count


def displaced(path: Sequence[Step], displacements: Iterable[tuple[Sequence[Step], Triple]]) -> list[Triple]:
    """Return the displacements of a frame, each in the last axes of its path that lead to those given."""
    result = [NULL] * (len(path) + 1)
    for other, d in displacements:
        if not is_null(d):
            level = common(path, other)
            result[level] = add3(result[level], carried_back(d, other[level:]))
    return result
