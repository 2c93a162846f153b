"""The mass matrix by composite rigid bodies [Walker & Orin 1982], in local axes.

The part of the tree beyond a motion, frozen, is one rigid body: its mass, first moment and inertia about the
frame's origin are carried inwards once. A unit acceleration of a speed moves that body; the wrench it needs, carried on
inwards, gives the entries for the speeds that it meets.
"""

from __future__ import annotations

from typing import final

from symbody.geometry.triple import NULL, Triple
from symbody.multibody import System
from symbody.symbolic import Expr, Matrix, dot3, number, scale3

from .base_inertia import base_inertias
from .composite import Composite
from .frame_tree import FrameTree
from .partial_motion import PartialTwist
from .subset_sum import SubsetSum
from .wrench import Wrench, alike

_ZERO = number(0)


def mass_matrix(system: System, tree: FrameTree) -> Matrix:
    """Return the mass matrix of a tree of rigid frames."""
    return _MassMatrix(system, tree).matrix()


@final
class _MassMatrix:
    """The recursion from the leaves to the root."""

    def __init__(self, system: System, tree: FrameTree) -> None:
        self._tree = tree
        n = len(system.speeds)
        self._entries = [[_ZERO] * n for _ in range(n)]
        self._composites: list[Composite | None] = [None] * len(tree.frames)
        self._wrenches: list[dict[int, Wrench]] = [{} for _ in tree.frames]
        self._sliding: dict[int, list[int]] = {}
        for place, body in base_inertias(system, tree).all():
            self._join(place, body)

    def matrix(self) -> Matrix:
        for place in range(len(self._tree.frames) - 1, -1, -1):
            if place in self._sliding:
                self._slide(self._sliding[place])
            composite = self._composites[place]
            if composite is not None:
                self._pass_on(place, composite)
        return Matrix(self._entries)

    def _join(self, place: int, composite: Composite) -> None:
        other = self._composites[place]
        self._composites[place] = composite if other is None else other.plus(composite)

    def _pass_on(self, place: int, composite: Composite) -> None:
        parent, moving = self._tree.parents[place], self._tree.coordinates[place]
        slides = bool(moving) and place > 0 and not self._tree.motion(place).rotates
        if moving:
            twists = self._tree.partial_twists(place)
            self._meet(twists, self._wrenches[place])
            if slides:
                self._sliding.setdefault(parent, []).append(place)
            else:
                self._move(twists, composite, place)
        if place == 0 or not self._tree.carried[parent]:
            return
        motion = self._tree.motion(place)
        if slides:
            for k, twist in self._tree.partial_twists(place).items():
                self._carry(place, k, composite.wrench(NULL, twist.drift))
        self._join(parent, composite.to_parent(motion))
        for k, wrench in self._wrenches[place].items():
            self._carry(parent, k, wrench.to_parent(motion))

    def _meet(self, twists: dict[int, PartialTwist], wrenches: dict[int, Wrench]) -> None:
        """Add the entries between the speeds of a motion and those beyond it."""
        for j, wrench in wrenches.items():
            for k, twist in twists.items():
                self._add(j, k, _power(twist, wrench) * (2 if j == k else 1))

    def _move(self, twists: dict[int, PartialTwist], composite: Composite, place: int) -> None:
        """Add the entries among the speeds of a motion, and start their wrenches."""
        own = {k: composite.wrench(twist.spin, twist.drift) for k, twist in twists.items()}
        for j, wrench in own.items():
            for k, twist in twists.items():
                if j >= k:
                    self._add(j, k, _power(twist, wrench))
        for k, wrench in own.items():
            self._carry(place, k, wrench)

    def _slide(self, children: list[int]) -> None:
        """Add the entries among translations from one parent: what moves alike shares the sum of masses."""
        children.reverse()
        composites = [self._composites[child] for child in children]
        total = SubsetSum([_ZERO if body is None else body.mass for body in composites], _plus)
        moved = alike(self._tree, children)
        for k in moved:
            for j in moved:
                if j <= k:
                    self._add(j, k, _overlap(moved[j], moved[k], total))

    def _carry(self, place: int, k: int, wrench: Wrench) -> None:
        wrenches = self._wrenches[place]
        wrenches[k] = wrenches[k].plus(wrench) if k in wrenches else wrench

    def _add(self, j: int, k: int, value: Expr) -> None:
        total = self._entries[j][k] + value
        self._entries[j][k] = self._entries[k][j] = total


def _plus(a: Expr, b: Expr) -> Expr:
    return a + b


def _power(twist: PartialTwist, wrench: Wrench) -> Expr:
    return dot3(twist.spin, wrench.moment) + dot3(twist.drift, wrench.force)


def _overlap(first: dict[Triple, int], second: dict[Triple, int], total: SubsetSum[Expr]) -> Expr:
    """Return the sum of m v . w over the children, v and w being their partial velocities."""
    result = _ZERO
    for v, these in first.items():
        for w, those in second.items():
            both = these & those
            if both:
                result += (
                    dot3(scale3(total(both), v), w) if both == these else dot3(v, scale3(total(both), w))
                )
    return result
