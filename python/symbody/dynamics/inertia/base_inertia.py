"""Base inertias: each mass is kept in the frame where it takes fewest operations [Mayeda, Yoshida & Osuka 1990].

Mass on the axis of a joint is at rest in both links that the joint connects. For the z axis, such a line of mass has a
mass m, a moment h_z and a second moment S_zz. It may be counted with the link before the joint: the equations stay the
same, and 7 of the 10 inertial parameters are left beyond the joint [Gautier & Khalil 1990]. Inertia without mass may be
counted with the link before a sliding joint. Bodies on fixed joints are one body.

A mass may also be taken out of a body, and put where the acceleration is known anyway: at the origin of a frame that
the body carries. It is chosen so that one component of the body's moment vanishes. Mass removed in this way from
the axis of the joint is subtracted from the link before.

Only numbers are moved, since their sums are numbers. Sums of symbols would have to be computed, and would hide the
symbols of the model.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import NamedTuple, final

from symbody.dynamics.tree.frame_tree import FrameTree
from symbody.dynamics.tree.rigid_group import RigidGroups
from symbody.geometry.component.triple import NULL, Triple, is_null
from symbody.multibody import Body, System
from symbody.symbolic import Expr, number, scale3

from .composite import Composite, composite, particle, rotor

_ZERO = number(0)
_NOTHING = rotor((_ZERO, _ZERO, _ZERO, _ZERO, _ZERO, _ZERO))


class Particle(NamedTuple):
    """A mass at a place in a frame."""

    mass: Expr
    position: Triple


@dataclass(frozen=True)
class BaseInertias:
    """The inertias that move with each frame, by the frame's place in the tree.

    Attributes:
        bodies: the bodies with symbols, which are kept as they are.
        composites: the sums of the others.
        particles: masses taken out of composites.
    """

    bodies: list[tuple[int, Body]] = field(default_factory=list)
    composites: dict[int, Composite] = field(default_factory=dict)
    particles: list[tuple[int, Particle]] = field(default_factory=list)

    def all(self) -> Iterator[tuple[int, Composite]]:
        """Return every inertia as a composite."""
        yield from ((place, composite(body)) for place, body in self.bodies)
        yield from sorted(self.composites.items())
        yield from ((place, particle(*taken)) for place, taken in self.particles)


def base_inertias(system: System, tree: FrameTree, *, particles: bool = False) -> BaseInertias:
    """Return the inertias of a system, with numbers moved to where they take fewest operations.

    Args:
        system: the bodies.
        tree: the frames of the system.
        particles: whether masses may be taken out of bodies. This shortens the wrenches of a motion.
    """
    regrouping = _Regrouping(system, tree)
    regrouping.run(particles=particles)
    return regrouping.result


class _Way(NamedTuple):
    """A way to divide a body: into a particle at a frame, and the rest."""

    operations: int
    left: Composite
    taken: tuple[tuple[int, Particle], ...] = ()


@final
class _Regrouping:
    """The recursion from the leaves to the root."""

    def __init__(self, system: System, tree: FrameTree) -> None:
        self._tree, self._groups = tree, RigidGroups(tree)
        self._mass = 0.0
        self.result = BaseInertias()
        for body in system.bodies:
            place, whole = tree.index(body.frame), composite(body)
            if whole.is_numeric:
                self._keep(place, whole)
                self._mass += abs(float(body.mass))
            else:
                self.result.bodies.append((place, body))
        self._owners = set(self.result.composites)

    def run(self, *, particles: bool) -> None:
        composites = self.result.composites
        for place in sorted(composites, reverse=True):
            if not self._tree.carried[place]:
                del composites[place]
                continue
            way = min(self._ways(place), key=lambda way: way.operations) if particles else self._whole(place)
            line = self._line(place, way.left)
            composites[place] = way.left.minus(line)
            if composites[place].is_null:
                del composites[place]
            self.result.particles.extend(way.taken)
            if place and self._tree.carried[self._groups.before(place)]:
                self._keep(self._tree.parents[place], line)

    def _keep(self, place: int, inertia: Composite) -> None:
        """Add an inertia to the link of a frame."""
        if inertia.is_null:
            return
        while place != self._groups.home[place]:
            inertia = inertia.to_parent(self._tree.motions[place])
            place = self._tree.parents[place]
        known = self.result.composites.get(place)
        self.result.composites[place] = inertia if known is None else known.plus(inertia)

    def _line(self, place: int, whole: Composite) -> Composite:
        """Return the part of a body that may be kept in the link before, unless this has no inertia of numbers."""
        before = self._groups.before(place)
        if place == 0 or (self._tree.carried[before] and before not in self._owners):
            return _NOTHING
        motion = self._tree.motions[place]
        if motion.turn_axis is not None:
            return _on_axis(whole, motion.turn_axis)
        return _NOTHING if motion.rotates else rotor(whole.inertia)

    # --- particles ---

    def _ways(self, place: int) -> Iterator[_Way]:
        """Return the ways to divide a body: as a whole, and without a mass at its centre or at a branch."""
        whole = self.result.composites[place]
        yield self._whole(place)
        if not whole.mass.is_zero:
            center = Particle(whole.mass, scale3(1 / whole.mass, whole.moment))
            yield self._without(place, center.position, place, center)
        for branch in self._groups.branches(place):
            d = self._tree.motions[branch].displacement
            for h, r in zip(whole.moment, d, strict=True):
                if not h.is_zero and not r.is_zero and abs(float(h / r)) <= self._mass:
                    yield self._without(place, d, branch, Particle(h / r, NULL))

    def _whole(self, place: int) -> _Way:
        whole = self.result.composites[place]
        return _Way(self._operations(place, whole), whole)

    def _without(self, place: int, position: Triple, at: int, taken: Particle) -> _Way:
        left = self.result.composites[place].minus(particle(taken.mass, position))
        moved = 6 + 10 * _count(taken.position)
        return _Way(moved + self._operations(place, left), left, ((at, taken),))

    def _operations(self, place: int, whole: Composite) -> int:
        """Count the operations of the wrench of a body, less the part that the link before keeps.

        A mass takes a product and a sum per component of the force. A component of the first moment takes these, and
        two of each for the torque. An entry of the second moments takes two or three of each.
        """
        left = whole.minus(self._line(place, whole))
        travels = self._groups.travels[place]
        x, y, z = left.second_moments
        pairs = [2 * _count(pair) for pair in ((x, y), (y, z), (z, x))]
        return (
            (6 if travels else 0) * _count((left.mass,))
            + (10 if travels else 4) * _count(left.moment)
            + 6 * _count(left.inertia[3:])
            + sum(pairs)
        )


def _count(entries: tuple[Expr, ...]) -> int:
    return sum(not entry.is_zero for entry in entries)


def _on_axis(whole: Composite, k: int) -> Composite:
    """Return the line of mass on an axis through the origin whose removal leaves the fewest entries.

    A body that is symmetric about the axis, as a wheel, keeps only its moment of inertia about the axis.
    """
    i, j = (k + 1) % 3, (k + 2) % 3
    J, h, zero = whole.inertia, whole.moment, _ZERO
    is_wheel = J[i] == J[j] and is_null((J[3], J[4], J[5])) and h[i].is_zero and h[j].is_zero
    spread = J[i] if is_wheel else whole.second_moments[k]
    moment, inertia = [zero] * 3, [zero] * 6
    moment[k], inertia[i], inertia[j] = h[k], spread, spread
    x, y, z, u, v, w = inertia
    return Composite(whole.mass, (moment[0], moment[1], moment[2]), (x, y, z, u, v, w))
