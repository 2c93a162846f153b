"""The mass matrix by composite rigid bodies [Walker & Orin 1982], in local axes.

The part of the tree beyond a motion, frozen, is one rigid body: its mass, first moment and inertia about the
frame's origin are carried inwards once. A unit acceleration of a coordinate moves that body; the wrench it needs,
carried on inwards, gives the entries for the coordinates that it meets.
"""

from __future__ import annotations

from typing import NamedTuple, final

from symbody.geometry.motion import Motion, Rotation
from symbody.geometry.triple import NULL, Triple, is_null
from symbody.multibody import Body, System
from symbody.symbolic import Expr, Matrix, add3, cos, cross3, dot3, matvec3, number, scale3, sin

from .frame_tree import FrameTree
from .partial_motion import PartialTwist
from .subset_sum import SubsetSum
from .wrench import Wrench, alike

Tensor = tuple[Expr, Expr, Expr, Expr, Expr, Expr]
"""A symmetric 3x3 matrix: xx, yy, zz, yz, xz, xy."""

_ZERO = number(0)
_NO_INERTIA: Tensor = (_ZERO, _ZERO, _ZERO, _ZERO, _ZERO, _ZERO)


class Composite(NamedTuple):
    """A rigid body seen from a frame."""

    mass: Expr
    moment: Triple
    """The first moment, mass times position of the centre of mass."""
    inertia: Tensor
    """About the frame's origin."""

    def plus(self, other: Composite) -> Composite:
        """Return both bodies as one."""
        a, b = self.inertia, other.inertia
        x, y, z = add3((a[0], a[1], a[2]), (b[0], b[1], b[2]))
        u, v, w = add3((a[3], a[4], a[5]), (b[3], b[4], b[5]))
        return Composite(self.mass + other.mass, add3(self.moment, other.moment), (x, y, z, u, v, w))

    def to_parent(self, motion: Motion) -> Composite:
        """Return the body as seen from the parent."""
        turned = Composite(self.mass, motion.to_parent(self.moment), turned_tensor(self.inertia, motion))
        return turned if is_null(motion.displacement) else turned.displaced(motion.displacement)

    def displaced(self, d: Triple) -> Composite:
        """Return the body after a displacement d.

        With the new moment ``h' = h + m d`` the inertia grows by ``(d . s) 1 - sym(d s)`` for ``s = h + h'``,
        written so that the products are few.
        """
        h = self.moment
        moment = add3(h, scale3(self.mass, d))
        x, y, z = (d[k] * (h[k] + moment[k]) for k in range(3))
        xx, yy, zz, yz, xz, xy = self.inertia
        cross = [d[i] * moment[j] + d[j] * h[i] for i, j in ((1, 2), (0, 2), (0, 1))]
        inertia = (xx + (y + z), yy + (x + z), zz + (x + y), yz - cross[0], xz - cross[1], xy - cross[2])
        return Composite(self.mass, moment, inertia)

    def wrench(self, spin: Triple, linear: Triple) -> Wrench:
        """Return the wrench that gives the body an angular acceleration, and its origin a linear one, from rest."""
        force = add3(scale3(self.mass, linear), cross3(spin, self.moment))
        return Wrench(force, add3(tensor_times(self.inertia, spin), cross3(self.moment, linear)))


def tensor_times(tensor: Tensor, v: Triple) -> Triple:
    """Return the product of a symmetric matrix and a vector."""
    xx, yy, zz, yz, xz, xy = tensor
    return matvec3((xx, xy, xz, xy, yy, yz, xz, yz, zz), v)


def turned_tensor(tensor: Tensor, motion: Motion) -> Tensor:
    """Return ``R J R^T``."""
    if not motion.rotates or all(entry.is_zero for entry in tensor):
        return tensor
    if isinstance(motion, Rotation):
        return _turned_about(tensor, motion.axis, cos(motion.angle), sin(motion.angle))
    xx, yy, zz, yz, xz, xy = tensor
    columns = [motion.to_parent(row) for row in ((xx, xy, xz), (xy, yy, yz), (xz, yz, zz))]
    x, y, z = (motion.to_parent((columns[0][k], columns[1][k], columns[2][k])) for k in range(3))
    return x[0], y[1], z[2], y[2], x[2], x[1]


def _turned_about(tensor: Tensor, axis: int, c: Expr, s: Expr) -> Tensor:
    """Turn in the plane (i, j): with ``p = c (J_ii - J_jj) - 2 s J_ij`` its entries change by c p and s p."""
    i, j = (axis + 1) % 3, (axis + 2) % 3
    entries = list(tensor)
    mixed = 3 + axis
    p = c * (tensor[i] - tensor[j]) - s * (2 * tensor[mixed])
    cp = c * p
    entries[i], entries[j], entries[mixed] = tensor[j] + cp, tensor[i] - cp, tensor[mixed] + s * p
    entries[3 + j], entries[3 + i] = (
        c * tensor[3 + j] - s * tensor[3 + i],
        s * tensor[3 + j] + c * tensor[3 + i],
    )
    return entries[0], entries[1], entries[2], entries[3], entries[4], entries[5]


def mass_matrix(system: System, tree: FrameTree) -> Matrix:
    """Return the mass matrix of a tree of rigid frames."""
    return _MassMatrix(system, tree).matrix()


@final
class _MassMatrix:
    """The recursion from the leaves to the root."""

    def __init__(self, system: System, tree: FrameTree) -> None:
        self._tree = tree
        n = len(system.coordinates)
        self._entries = [[_ZERO] * n for _ in range(n)]
        self._composites: list[Composite | None] = [None] * len(tree.frames)
        self._wrenches: list[dict[int, Wrench]] = [{} for _ in tree.frames]
        self._sliding: dict[int, list[int]] = {}
        for body in system.bodies:
            self._join(tree.index(body.frame), composite(body))

    def matrix(self) -> Matrix:
        for place in range(len(self._tree.frames) - 1, -1, -1):
            if place in self._sliding:
                self._slide(self._sliding[place])
            composite = self._composites[place]
            if place > 0 and composite is not None:
                self._pass_on(place, composite)
        return Matrix(self._entries)

    def _join(self, place: int, composite: Composite) -> None:
        other = self._composites[place]
        self._composites[place] = composite if other is None else other.plus(composite)

    def _pass_on(self, place: int, composite: Composite) -> None:
        motion, parent, moving = (
            self._tree.motion(place),
            self._tree.parents[place],
            self._tree.coordinates[place],
        )
        if moving:
            twists = self._tree.partial_twists(place)
            self._meet(motion, twists, self._wrenches[place])
            if motion.rotates:
                self._move(motion, twists, composite, place)
            else:
                self._sliding.setdefault(parent, []).append(place)
        if not self._tree.carried[parent]:
            return
        if moving and not motion.rotates:
            for k, twist in self._tree.partial_twists(place).items():
                self._carry(place, k, composite.wrench(NULL, twist.drift))
        self._join(parent, composite.to_parent(motion))
        for k, wrench in self._wrenches[place].items():
            self._carry(parent, k, wrench.to_parent(motion))

    def _meet(self, motion: Motion, twists: dict[int, PartialTwist], wrenches: dict[int, Wrench]) -> None:
        """Add the entries between the coordinates of a motion and those beyond it."""
        for j, wrench in wrenches.items():
            for k, twist in twists.items():
                self._add(j, k, _power(motion, twist, wrench) * (2 if j == k else 1))

    def _move(
        self, motion: Motion, twists: dict[int, PartialTwist], composite: Composite, place: int
    ) -> None:
        """Add the entries among the coordinates of a motion, and start their wrenches."""
        own = {k: composite.wrench(twist.spin, motion.to_child(twist.drift)) for k, twist in twists.items()}
        for j, wrench in own.items():
            for k, twist in twists.items():
                if j >= k:
                    self._add(j, k, _power(motion, twist, wrench))
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


def composite(body: Body) -> Composite:
    """Return a body as seen from its own frame."""
    (xx, yy, zz), (yz, xz, xy) = body.moments, body.products
    return Composite(body.mass, NULL, (xx, yy, zz, -yz, -xz, -xy))


def _plus(a: Expr, b: Expr) -> Expr:
    return a + b


def _power(motion: Motion, twist: PartialTwist, wrench: Wrench) -> Expr:
    power = dot3(twist.spin, wrench.moment)
    return power if is_null(twist.drift) else power + dot3(twist.drift, motion.to_parent(wrench.force))


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
