"""Forward dynamics by articulated bodies [Featherstone 1983; 2008, sec. 7.3], in local axes.

The tree beyond a frame, free to move at its joints, answers an acceleration a of the frame by the wrench
``I^A a + p^A``. With ``X*`` the transform of wrenches from a frame to its parent, X that of accelerations from the
parent p, and S the partial twist of frame i in its parent by one speed u:

    I_i^A = I_i + sum_c X* I_c^a X            p_i^A = f_i + sum_c X* p_c^a      over the children c of frame i
    U = I^A S,  D = S . U,  G = U / D                                           inwards, speed by speed
    I^a = I^A - G U^T                         p^a = p^A - G (S . p^A)
    u' = -(S . p^A) / D - G . (X a_p)         a = X a_p + S u'                  outwards

All accelerations count from those that the frames have where the accelerations u' are zero. The f_i are then the
wrenches of the recursion of Newton-Euler at rest, and nothing else of gravity, speeds, loads and prescribed motions is
left. Every elementary motion is a joint; the freedoms of a motion by several speeds are released one after another.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple, final

from symbody.dynamics.inertia.articulated_inertia import ArticulatedInertia
from symbody.dynamics.inertia.base_inertia import base_inertias
from symbody.dynamics.inertia.composite import Composite
from symbody.dynamics.inertia.wrench import Wrench
from symbody.dynamics.recursion.recursive_newton_euler import at_rest, needed_wrenches
from symbody.dynamics.tree.compared_forms import compared_forms
from symbody.dynamics.tree.frame_tree import FrameTree, frame_tree, tree_of_forms
from symbody.dynamics.tree.other_forms import have_other_forms
from symbody.dynamics.tree.partial_motion import PartialTwist
from symbody.errors import ModelError
from symbody.geometry.component.triple import NULL, Triple, is_null
from symbody.geometry.motion.frame_motion import FrameMotion
from symbody.multibody import System
from symbody.symbolic import Expr, add3, cross3, number, scale3

from .added_mass import has_added_mass


def is_applicable(system: System, tree: FrameTree) -> bool:
    """Return whether every speed drives one rigid motion alone and accelerations are otherwise uncoupled."""
    driven = [k for moving in tree.moved_by for k in moving]
    return (
        tree.is_rigid
        and not system.constraints
        and not system.eliminated
        and sorted(driven) == list(range(len(system.speeds)))
        and not has_added_mass(system)
    )


def articulated_tree(system: System) -> FrameTree:
    """Return the first tree to which the recursion is applicable, or the given one."""
    given = frame_tree(system)
    if is_applicable(system, given) or not have_other_forms(given.frames, given.parents):
        return given
    trees = (tree_of_forms(system, forms) for forms in compared_forms(system) if forms)
    return next((tree for tree in trees if is_applicable(system, tree)), given)


def accelerations(system: System, tree: FrameTree) -> tuple[Expr, ...]:
    """Return the accelerations of a tree to which the recursion is applicable, one per speed."""
    return _ArticulatedBodies(system, tree).accelerations(needed_wrenches(system, tree, at_rest(system)))


class _Joint(NamedTuple):
    """The response of a joint with one speed."""

    speed: int
    """The place of the speed in those of the system."""
    S: PartialTwist
    G: Wrench
    """``U / D``: the joint acceleration per unit acceleration of the frame, with the sign reversed."""
    own: Expr
    """``-(S . p^A) / D``: the acceleration of the joint where the frame has none."""


@final
class _ArticulatedBodies:
    """The recursion inwards, then outwards."""

    def __init__(self, system: System, tree: FrameTree) -> None:
        self._system, self._tree = system, tree
        self._rigid: list[Composite | None] = [None] * len(tree.frames)
        self._articulated: list[ArticulatedInertia | None] = [None] * len(tree.frames)
        """By frame: ``I^A`` is the sum of both. What is rigid is kept apart, as its transform is shorter."""
        self._joints: list[list[_Joint]] = [[] for _ in tree.frames]
        for place, body in base_inertias(system, tree).all():
            self._add_rigid(place, body)

    def accelerations(self, wrenches: Sequence[Wrench]) -> tuple[Expr, ...]:
        p = list(wrenches)
        for place in range(len(p) - 1, -1, -1):
            if self._tree.carried[place]:
                for k in self._tree.moved_by[place]:
                    p[place] = self._release(place, k, p[place])
                self._carry_inwards(place, p)
        return self._outward()

    def _release(self, place: int, k: int, p: Wrench) -> Wrench:
        """Take the freedom of one speed out of the inertia of a frame, and return its bias without it."""
        S, inertia = self._tree.partial_twists(place)[k], self._inertia(place)
        U = _NOTHING if inertia is None else inertia.wrench(S.spin, S.drift)
        D = U.power(S)
        if inertia is None or D.is_zero:
            raise ModelError(
                f"forward_dynamics: the {self._kind(k)} {self._system.driving[k]} moves no inertia; expected bodies "
                f"with mass beyond its motion, or leave it out of the {self._kind(k)}s"
            )
        reciprocal = 1 / D
        G, missing = U.scaled(reciprocal), p.power(S)
        self._rigid[place], self._articulated[place] = None, inertia.released(U, G)
        self._joints[place].append(_Joint(k, S, G, -(reciprocal * missing)))
        return p.minus(G.scaled(missing))

    def _kind(self, k: int) -> str:
        return "speed" if k < len(self._system.quasi_velocities) else "coordinate"

    def _inertia(self, place: int) -> ArticulatedInertia | None:
        rigid, articulated = self._rigid[place], self._articulated[place]
        if rigid is None:
            return articulated
        inertia = ArticulatedInertia.of(rigid)
        return inertia if articulated is None else inertia.plus(articulated)

    def _carry_inwards(self, place: int, p: list[Wrench]) -> None:
        """Add the inertia and the bias of a frame to those of its parent."""
        parent = self._tree.parents[place]
        if place == 0 or not self._tree.carried[parent]:
            return
        motion = self._tree.motions[place]
        p[parent] = p[parent].plus(p[place].to_parent(motion))
        rigid, articulated = self._rigid[place], self._articulated[place]
        if rigid is not None:
            self._add_rigid(parent, rigid.to_parent(motion))
        if articulated is not None:
            self._add_articulated(parent, articulated.to_parent(motion))

    def _add_rigid(self, place: int, body: Composite) -> None:
        other = self._rigid[place]
        self._rigid[place] = body if other is None else other.plus(body)

    def _add_articulated(self, place: int, inertia: ArticulatedInertia) -> None:
        other = self._articulated[place]
        self._articulated[place] = inertia if other is None else other.plus(inertia)

    def _outward(self) -> tuple[Expr, ...]:
        result = [number(0)] * len(self._system.speeds)
        a = [(NULL, NULL)] * len(self._tree.frames)
        for place in range(len(a)):
            angular, linear = a[0]
            if place > 0:
                angular, linear = _carried(a[self._tree.parents[place]], self._tree.motions[place])
            for joint in reversed(self._joints[place]):
                result[joint.speed] = rate = _response(joint, angular, linear)
                angular = add3(angular, scale3(rate, joint.S.spin))
                linear = add3(linear, scale3(rate, joint.S.drift))
            a[place] = (angular, linear)
        return tuple(result)


_NOTHING = Wrench(NULL, NULL)


def _carried(acceleration: tuple[Triple, Triple], motion: FrameMotion) -> tuple[Triple, Triple]:
    """Return the angular acceleration, and that of the origin, of a frame that is fixed in its parent."""
    angular, linear = acceleration
    if not is_null(motion.displacement):
        linear = add3(linear, cross3(angular, motion.displacement))
    return motion.to_child(angular), motion.to_child(linear)


def _response(joint: _Joint, angular: Triple, linear: Triple) -> Expr:
    """Return ``own - G . a``, term by term.

    The components in which the joint doesn't move come first. For a joint along one axis, what they leave is the new
    component of the frame's acceleration along this axis.
    """
    G = (*joint.G.moment, *joint.G.force)
    S = (*joint.S.spin, *joint.S.drift)
    rate = joint.own
    for k in sorted(range(6), key=lambda k: not S[k].is_zero):
        rate -= G[k] * (*angular, *linear)[k]
    return rate
