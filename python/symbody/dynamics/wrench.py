"""Wrenches on frames, and what they do along the speeds."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple, final

from symbody.geometry.motion import Motion
from symbody.geometry.triple import Triple, is_null
from symbody.symbolic import Expr, add3, cross3, dot3, number, sub3

from .frame_tree import FrameTree
from .partial_motion import PartialTwist
from .subset_sum import SubsetSum


class Wrench(NamedTuple):
    """A force and the moment about the origin of a frame, in its axes."""

    force: Triple
    moment: Triple

    def plus(self, other: Wrench) -> Wrench:
        """Return the sum of two wrenches on one frame."""
        return Wrench(add3(self.force, other.force), add3(self.moment, other.moment))

    def minus(self, other: Wrench) -> Wrench:
        """Return the difference of two wrenches on one frame."""
        return Wrench(sub3(self.force, other.force), sub3(self.moment, other.moment))

    def to_parent(self, motion: Motion) -> Wrench:
        """Return the same wrench on the parent."""
        force, moment = motion.to_parent(self.force), motion.to_parent(self.moment)
        if is_null(motion.displacement):
            return Wrench(force, moment)
        return Wrench(force, add3(moment, cross3(motion.displacement, force)))

    @property
    def is_null(self) -> bool:
        """Whether there is neither force nor moment."""
        return is_null(self.force) and is_null(self.moment)


def generalized_forces(tree: FrameTree, wrenches: Sequence[Wrench]) -> tuple[Expr, ...]:
    """Return the power of wrenches, one a frame and in its axes, per unit of each speed."""
    return _Inward(tree, wrenches).forces()


@final
class _Inward:
    """The recursion from the leaves to the root."""

    def __init__(self, tree: FrameTree, wrenches: Sequence[Wrench]) -> None:
        self._tree = tree
        self._wrenches = list(wrenches)
        self._forces = [number(0)] * len(tree.system.speeds)
        self._sliding: dict[int, list[int]] = {}
        """By parent: the children that move without turning."""

    def forces(self) -> tuple[Expr, ...]:
        for place in range(len(self._tree.frames) - 1, -1, -1):
            if place in self._sliding:
                self._slide(self._sliding[place])
            if not self._wrenches[place].is_null:
                self._pass_on(place, self._wrenches[place])
        return tuple(self._forces)

    def _pass_on(self, place: int, wrench: Wrench) -> None:
        parent, moving = self._tree.parents[place], self._tree.coordinates[place]
        if moving and place and not self._tree.motion(place).rotates:
            self._sliding.setdefault(parent, []).append(place)
        elif moving:
            self._turn(wrench, self._tree.partial_twists(place))
        if place and self._tree.carried[parent]:
            self._wrenches[parent] = self._wrenches[parent].plus(wrench.to_parent(self._tree.motion(place)))

    def _turn(self, wrench: Wrench, twists: dict[int, PartialTwist]) -> None:
        for k, twist in twists.items():
            self._forces[k] += dot3(twist.spin, wrench.moment) + dot3(twist.drift, wrench.force)

    def _slide(self, children: list[int]) -> None:
        """Add the power on translations from one parent: what moves alike shares the sum of forces."""
        children.reverse()
        total = SubsetSum([self._wrenches[child].force for child in children], add3)
        for k, drifts in alike(self._tree, children).items():
            for drift, subset in drifts.items():
                self._forces[k] += dot3(drift, total(subset))


def alike(tree: FrameTree, children: Sequence[int]) -> dict[int, dict[Triple, int]]:
    """Return, by speed and partial velocity, the subset of children that have this partial velocity."""
    result: dict[int, dict[Triple, int]] = {}
    for bit, child in enumerate(children):
        for k, twist in tree.partial_twists(child).items():
            subsets = result.setdefault(k, {})
            subsets[twist.drift] = subsets.get(twist.drift, 0) | (1 << bit)
    return result
