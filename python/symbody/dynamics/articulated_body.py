"""Forward dynamics by articulated bodies [Featherstone 1983; 2008, ch. 7], in local axes.

The part of the tree beyond a joint, its joints free to give way, answers an acceleration with a wrench that is linear
in it: by an articulated inertia, and a bias. Both are carried inwards once, the accelerations outwards once.

All accelerations count from those that the frames have where the accelerations of the coordinates are zero. What is
carried inwards as bias then begins with the wrenches of the recursion of `newton_euler`, and nothing else of gravity,
speeds, loads and prescribed motions is left. Every elementary motion is a joint; one that depends on several
speeds gives way for one after another.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple, final

from symbody.errors import ModelError
from symbody.geometry.motion import Motion
from symbody.geometry.triple import NULL, Triple, is_null
from symbody.multibody import System
from symbody.symbolic import Expr, add3, cross3, dot3, number, scale3

from .added_mass import has_added_mass
from .articulated_inertia import ArticulatedInertia
from .base_inertia import base_inertias
from .composite import Composite
from .frame_tree import FrameTree
from .newton_euler import at_rest, needed_wrenches
from .wrench import Wrench


def is_applicable(system: System, tree: FrameTree) -> bool:
    """Tell whether every speed drives one rigid motion alone, with nothing else between accelerations."""
    driven = [k for moving in tree.coordinates for k in moving]
    return (
        tree.is_rigid
        and not system.constraints
        and sorted(driven) == list(range(len(system.speeds)))
        and not has_added_mass(system)
    )


def accelerations(system: System, tree: FrameTree) -> tuple[Expr, ...]:
    """Return the accelerations of a tree to which the recursion is applicable."""
    return _ArticulatedBody(system, tree).accelerations(needed_wrenches(system, tree, at_rest(system)))


class _Joint(NamedTuple):
    """How one coordinate of a motion gives way."""

    coordinate: int
    spin: Triple
    drift: Triple
    """Both in the child's axes."""
    share: Wrench
    """``G = I S / (S . I S)``: what of an acceleration of the frame the joint takes up, with the opposite sign."""
    own: Expr
    """The acceleration of the coordinate where the frame has none."""


@final
class _ArticulatedBody:
    """The recursion inwards, then outwards."""

    def __init__(self, system: System, tree: FrameTree) -> None:
        self._system, self._tree = system, tree
        self._rigid: list[Composite | None] = [None] * len(tree.frames)
        self._articulated: list[ArticulatedInertia | None] = [None] * len(tree.frames)
        self._joints: list[list[_Joint]] = [[] for _ in tree.frames]
        for place, body in base_inertias(system, tree).all():
            self._join_rigid(place, body)

    def accelerations(self, wrenches: Sequence[Wrench]) -> tuple[Expr, ...]:
        bias = list(wrenches)
        for place in range(len(bias) - 1, -1, -1):
            if self._tree.carried[place]:
                self._inward(place, bias)
        return self._outward()

    def _inward(self, place: int, bias: list[Wrench]) -> None:
        for k in self._tree.coordinates[place]:
            bias[place] = self._give_way(place, k, bias[place])
        parent = self._tree.parents[place]
        if place == 0 or not self._tree.carried[parent]:
            return
        motion = self._tree.motion(place)
        bias[parent] = bias[parent].plus(bias[place].to_parent(motion))
        rigid, articulated = self._rigid[place], self._articulated[place]
        if rigid is not None:
            self._join_rigid(parent, rigid.to_parent(motion))
        if articulated is not None:
            self._join_articulated(parent, articulated.to_parent(motion))

    def _join_rigid(self, place: int, body: Composite) -> None:
        other = self._rigid[place]
        self._rigid[place] = body if other is None else other.plus(body)

    def _join_articulated(self, place: int, inertia: ArticulatedInertia) -> None:
        other = self._articulated[place]
        self._articulated[place] = inertia if other is None else other.plus(inertia)

    def _give_way(self, place: int, k: int, bias: Wrench) -> Wrench:
        """Take the joint's freedom out of the inertia and the bias of its frame."""
        spin, drift = self._tree.partial_twists(place)[k]
        inertia = self._inertia(place)
        needed = NOTHING if inertia is None else inertia.wrench(spin, drift)
        pivot = _power(spin, drift, needed)
        if inertia is None or pivot.is_zero:
            raise ModelError(
                f"forward_dynamics: the {self._kind(k)} {self._system.driving[k]} moves no inertia; expected bodies "
                f"with mass beyond its motion, or leave it out of the {self._kind(k)}s"
            )
        reciprocal = 1 / pivot
        share = Wrench(scale3(reciprocal, needed.force), scale3(reciprocal, needed.moment))
        missing = _power(spin, drift, bias)
        self._rigid[place], self._articulated[place] = None, inertia.released(needed, share)
        self._joints[place].append(_Joint(k, spin, drift, share, -(reciprocal * missing)))
        taken = Wrench(scale3(missing, share.force), scale3(missing, share.moment))
        return bias.minus(taken)

    def _kind(self, k: int) -> str:
        return "speed" if k < len(self._system.quasi_velocities) else "coordinate"

    def _inertia(self, place: int) -> ArticulatedInertia | None:
        rigid, articulated = self._rigid[place], self._articulated[place]
        if rigid is None:
            return articulated
        inertia = ArticulatedInertia.of(rigid)
        return inertia if articulated is None else inertia.plus(articulated)

    def _outward(self) -> tuple[Expr, ...]:
        result = [number(0)] * len(self._system.speeds)
        twists = [(NULL, NULL)] * len(self._tree.frames)
        for place in range(len(twists)):
            angular, linear = twists[0]
            if place > 0:
                angular, linear = _carried(twists[self._tree.parents[place]], self._tree.motion(place))
            for joint in reversed(self._joints[place]):
                result[joint.coordinate] = rate = _response(joint, angular, linear)
                angular = add3(angular, scale3(rate, joint.spin))
                linear = add3(linear, scale3(rate, joint.drift))
            twists[place] = (angular, linear)
        return tuple(result)


NOTHING = Wrench(NULL, NULL)


def _carried(twist: tuple[Triple, Triple], motion: Motion) -> tuple[Triple, Triple]:
    """Return the angular acceleration, and that of the origin, of a frame that is fixed in its parent."""
    angular, linear = twist
    if not is_null(motion.displacement):
        linear = add3(linear, cross3(angular, motion.displacement))
    return motion.to_child(angular), motion.to_child(linear)


def _response(joint: _Joint, angular: Triple, linear: Triple) -> Expr:
    """Return ``own - G . a``; first what the joint doesn't move itself, which is then its frame's own new component."""
    share = (*joint.share.moment, *joint.share.force)
    own = (*joint.spin, *joint.drift)
    rate = joint.own
    for k in sorted(range(6), key=lambda k: not own[k].is_zero):
        rate -= share[k] * (*angular, *linear)[k]
    return rate


def _power(spin: Triple, drift: Triple, wrench: Wrench) -> Expr:
    return dot3(spin, wrench.moment) + dot3(drift, wrench.force)
