"""Coordinates and components carried from one frame to another, along the chains that join them."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations
from typing import NamedTuple

from symbody.errors import FrameError
from symbody.geometry.component.triple import NULL, Triple, is_null
from symbody.geometry.motion.frame_motion import FrameMotion, Substitution
from symbody.symbolic import ENERGY, add3, derivation, sub3
from symbody.symbolic.given.arguments import brief

from .frame import Frame


def vector_components(v: Triple, source: Frame, target: Frame) -> Triple:
    """Return the components of a free vector in another frame: only the rotations act."""
    if is_null(v):
        return v
    up, down = path(source, target)
    with derivation(order=ENERGY):
        for motion in _rotations(up):
            v = motion.to_parent(v)
        for motion in _rotations(down):
            v = motion.to_child(v)
    return v


def _rotations(motions: Sequence[FrameMotion]) -> list[FrameMotion]:
    """Return the rotations among motions; two about one axis as their sum, if a variable drops out of it."""
    result = list[FrameMotion]()
    for motion in (each for each in motions if each.rotates):
        if total := _shorter_sum(result[-1], motion) if result else None:
            result.pop()
            result += [] if total.is_identity else [total]
        else:
            result.append(motion)
    return result


def _shorter_sum(one: FrameMotion, other: FrameMotion) -> FrameMotion | None:
    """Return two rotations about one axis as their sum if a variable drops out of it."""
    total = one.merged(other)
    return total if total is not None and total.leaves < one.leaves | other.leaves else None


def point_coordinates(p: Triple, source: Frame, target: Frame) -> Triple:
    """Return the coordinates of a point in another frame."""
    up, down = path(source, target)
    with derivation(order=ENERGY):
        p = _by_orientations(p, up) if _turns_back(up) else _outwards(p, up)
        for motion in down:
            p = motion.to_child(sub3(p, motion.displacement))
    return p


def _outwards(p: Triple, up: Sequence[FrameMotion]) -> Triple:
    """Return the coordinates of a point in the frame from which some motions lead to it, the last one first."""
    for motion in up:
        p = add3(motion.to_parent(p), motion.displacement)
    return p


def _turns_back(up: Sequence[FrameMotion]) -> bool:
    """Return whether a variable drops out of rotations, as q1 of ``rotate("Z", q1) * ... * rotate("Z", q2 - q1)``."""
    return len(_rotations(up)) < sum(motion.rotates for motion in up)


def _by_orientations(p: Triple, up: Sequence[FrameMotion]) -> Triple:
    """Return the same with the sums of such rotations: what was turned by a part of a sum is taken out of the axes.

    ``l*cos(q2)`` is shorter than ``l*(cos(q1)*cos(q2 - q1) - sin(q1)*sin(q2 - q1))``.
    """
    turns: list[FrameMotion] = []  # from the outermost inwards
    sums = [NULL]  # of the displacements in the axes before and behind each
    for motion in reversed(up):
        sums[-1] = add3(sums[-1], motion.displacement)
        if total := _shorter_sum(turns[-1], motion) if turns else None:
            behind = turns.pop().to_parent(sums.pop())
            sums[-1] = add3(sums[-1], behind)
        turn = total or motion
        if turn.rotates and not turn.is_identity:
            turns.append(turn)
            sums.append(NULL)
    p = add3(sums.pop(), p)
    for turn, before in zip(reversed(turns), reversed(sums), strict=True):
        p = add3(before, turn.to_parent(p))
    return p


class Ends(NamedTuple):
    """The end points of a vector: coordinates and frame of each."""

    tip: Triple
    tip_frame: Frame
    tail: Triple
    tail_frame: Frame

    def subs(self, substitution: Substitution) -> Ends:
        """Return the points with expressions substituted."""
        tip, tail = (
            (x.subs(substitution), y.subs(substitution), z.subs(substitution))
            for x, y, z in (self.tip, self.tail)
        )
        return Ends(tip, self.tip_frame.subs(substitution), tail, self.tail_frame.subs(substitution))


def difference(ends: Ends, target: Frame) -> Triple:
    """Return the components of the vector between two points in a frame.

    The difference is taken in the frame where the paths of the points to the target frame meet; from there on, only the
    vector is turned. In any other frame, rotations forth and back would have to cancel.
    """
    frames = ends.tip_frame, ends.tail_frame, target
    meeting = max((_common_ancestor(a, b) for a, b in combinations(frames, 2)), key=lambda frame: frame.depth)
    with derivation(order=ENERGY):
        tip = point_coordinates(ends.tip, ends.tip_frame, meeting)
        tail = point_coordinates(ends.tail, ends.tail_frame, meeting)
        return vector_components(sub3(tip, tail), meeting, target)


def _common_ancestor(a: Frame, b: Frame) -> Frame:
    up, _ = path(a, b)
    return a.chain[a.depth - len(up)]


def path(source: Frame, target: Frame) -> tuple[list[FrameMotion], list[FrameMotion]]:
    """Return the motions from the source up to the common ancestor, and from there down to the target."""
    up: list[FrameMotion] = []
    down: list[FrameMotion] = []
    a, b = source, target
    while a is not b and a.key != b.key:
        if a.depth >= b.depth and a.parent is not None and a.motion is not None:
            up.append(a.motion)
            a = a.parent
        elif b.parent is not None and b.motion is not None:
            down.append(b.motion)
            b = b.parent
        else:
            raise FrameError(
                f"{brief(source)} can't be seen from {brief(target)}: one is attached to {source.ancestor}, the other "
                f"to {target.ancestor}, and the place of a moving master frame is unknown; build both on the same one"
            )
    down.reverse()
    return up, down
