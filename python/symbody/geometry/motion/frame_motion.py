"""Motions of frames: the steps of which the chain of a frame is made.

A new kind of joint is one file with a final subclass of `FrameMotion` (docs/extending.md). It implements the abstract
methods, from which everything else follows. A motion that knows a shorter way to the same value overrides a method.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping, Sequence
from hashlib import blake2b
from types import MappingProxyType
from typing import ClassVar, TypeAlias

from symbody.deferred import cached_property
from symbody.geometry.component.triple import NULL, Rate, Scalar, Triple, is_null, rates
from symbody.geometry.component.turning import Accelerated, Nine, Turning
from symbody.geometry.component.twist import Twist
from symbody.symbolic import Expr, add3, cross3, matvec3, number, scale3, time_derivatives
from symbody.symbolic.expression.latex_layout import upright

Substitution: TypeAlias = Mapping[Expr, Scalar]
Rows: TypeAlias = tuple[Triple, Triple, Triple]
"""A 3x3 matrix by rows."""
Symmetric: TypeAlias = tuple[Expr, Expr, Expr, Expr, Expr, Expr]
"""A symmetric 3x3 matrix: xx, yy, zz, yz, xz, xy."""


class FrameMotion(ABC):
    """The placement of a frame (the child, B) in another one (the parent, A): a rotation R and a displacement d.

    A vector's components go up, from the child's axes to the parent's, by ``to_parent`` (R), and down by ``to_child``
    (R^T). In the formulas, w is the spin of B in A, and d' its drift.
    """

    tag: ClassVar[bytes]
    """The tag that distinguishes the kinds of motions in their keys."""
    is_rigid: bool = True
    """Whether the axes are orthonormal whatever the values of the variables."""
    rotates: bool = True
    """Whether R may differ from 1; without it, the motion is the translation by its displacement."""
    turn_axis: int | None = None
    """The axis (0, 1 or 2) of both frames about which the motion turns, if it is such a rotation and nothing else."""
    turn_angle: Expr | None = None
    """The angle of such a rotation."""

    twist: Twist | None = None
    """The twist of B in A, in the axes of B, where speeds of its own give it; None where the variables' rates do."""
    coordinate_rates: Mapping[Expr, Expr] = MappingProxyType({})
    """The coordinates whose rates are not speeds, and these rates by the speeds."""
    speeds: tuple[Expr, ...] = ()
    """The speeds of the twist that are unknown, unless the system lists others."""
    quaternion: tuple[Expr, ...] = ()
    """The Euler parameters among the coordinates, whose norm is one."""

    # --- what a motion is ---

    @property
    @abstractmethod
    def variables(self) -> tuple[Expr, ...]:
        """The expressions that fix the motion."""

    @property
    def displacement(self) -> Triple:
        """The child's origin, in the parent's axes."""
        return NULL

    @abstractmethod
    def to_parent(self, v: Triple) -> Triple:
        """Return the components in the parent's axes, given those in the child's."""

    @abstractmethod
    def to_child(self, v: Triple) -> Triple:
        """Return the components in the child's axes, given those in the parent's."""

    @abstractmethod
    def spin(self, rate: Rate) -> Triple:
        """Return the angular velocity of the child in the parent, in the child's axes."""

    @abstractmethod
    def inverse(self) -> tuple[FrameMotion, ...]:
        """Return the motions that bring the child back."""

    @abstractmethod
    def subs(self, substitution: Substitution) -> FrameMotion:
        """Return the motion with expressions substituted."""

    @abstractmethod
    def __repr__(self) -> str:
        """Return what makes the motion, as a user writes it."""

    def in_latex(self, variables: Sequence[str]) -> str:
        """Return the motion as textbooks write it, by its `variables` in LaTeX; by default its matrix isn't shown."""
        del variables
        return upright(str(self))

    def rewritten(self, variables: Sequence[Expr]) -> FrameMotion:
        """Return the motion with its `variables` in other forms; by default it keeps its form."""
        del variables
        return self

    def merged(self, following: FrameMotion) -> FrameMotion | None:
        """Return the one motion that this and the following one make, or None."""
        del following
        return None

    @property
    def is_identity(self) -> bool:
        """Whether the child is the parent."""
        return False

    @cached_property
    def key(self) -> bytes:
        """A digest of the values: equal for equal motions."""
        digest = blake2b(self.tag, digest_size=16)
        for variable in self.variables:
            digest.update(variable.fingerprint)
        return digest.digest()

    @cached_property
    def leaves(self) -> frozenset[Expr]:
        """The symbols and functions of time on which the motion depends."""
        return frozenset().union(*(variable.free_symbols for variable in self.variables))

    @cached_property
    def is_constant(self) -> bool:
        """Whether the child is fixed in the parent."""
        return not any(variable.depends_on_time for variable in self.variables)

    # --- velocities and accelerations ---

    def drift(self, rate: Rate) -> Triple:
        """Return the velocity of the child's origin in the parent, in the parent's axes."""
        return rates(self.displacement, rate)

    def child_twist(self, parent: Twist) -> Twist:
        """Return the twist of the child: ``w_B = R^T w_A + w``, ``v_B = R^T (v_A + w_A x d + d')``."""
        linear = parent.linear
        if not is_null(self.displacement):
            linear = add3(linear, cross3(parent.angular, self.displacement))
            linear = add3(linear, self.drift(time_derivatives))
        if not self.rotates:
            return Twist(parent.angular, linear)
        angular = add3(self.to_child(parent.angular), self.spin(time_derivatives))
        return Twist(angular, self.to_child(linear))

    def child_acceleration(self, parent: Accelerated, rate: Rate) -> Accelerated:
        """Return the acceleration of the child, ``a_B = R^T (a_A + F_A d + 2 w_A x d' + d'')``, and how it turns.

        Args:
            parent: the acceleration of the parent, and how it turns.
            rate: the time derivative, of places and of velocities; it may write rates of coordinates by speeds.
        """
        turning, linear = parent
        if not is_null(self.displacement):
            linear = self.material_acceleration(parent)
            drift = self.drift(rate)
            if not is_null(drift):
                coriolis = scale3(number(2), cross3(turning.velocity, drift))
                linear = add3(linear, add3(coriolis, rates(drift, rate)))
        if not self.rotates:
            return Accelerated(turning, linear)
        return Accelerated(self.child_turning(turning, rate), self.to_child(linear))

    def material_acceleration(self, parent: Accelerated) -> Triple:
        """Return ``a_A + F_A d``, the acceleration of the parent's point that coincides with the child's origin."""
        turning, linear = parent
        if is_null(turning.velocity) and is_null(turning.acceleration):
            return linear
        return add3(linear, matvec3(turning.field, self.displacement))

    def child_turning(self, parent: Turning, rate: Rate) -> Turning:
        """Return how the child turns: ``w_B = R^T w_A + w``, ``al_B = R^T al_A + w' + w_B x w``."""
        spin = self.spin(rate)
        velocity, angular = add3(self.to_child(parent.velocity), spin), rates(spin, rate)
        acceleration = add3(self.to_child(parent.acceleration), angular)
        return Turning(velocity, add3(acceleration, cross3(velocity, spin)))

    # --- matrices ---

    def matrix_to_parent(self, matrix: Nine) -> Nine:
        """Return ``R B R^T`` for a 3x3 matrix B in the child's axes."""
        return _carried(matrix, self.to_parent) if self.rotates else matrix

    def matrix_to_child(self, matrix: Nine) -> Nine:
        """Return ``R^T B R`` for a 3x3 matrix B in the parent's axes."""
        return _carried(matrix, self.to_child) if self.rotates else matrix

    def symmetric_to_parent(self, matrix: Symmetric) -> Symmetric:
        """Return ``R J R^T`` for a symmetric matrix J in the child's axes."""
        if not self.rotates:
            return matrix
        xx, yy, zz, yz, xz, xy = matrix
        columns = [self.to_parent(row) for row in ((xx, xy, xz), (xy, yy, yz), (xz, yz, zz))]
        x, y, z = (self.to_parent((columns[0][k], columns[1][k], columns[2][k])) for k in range(3))
        return x[0], y[1], z[2], y[2], x[2], x[1]


def _carried(matrix: Nine, carry: Callable[[Triple], Triple]) -> Nine:
    """Return a matrix with its rows, and then its columns, carried to other axes."""
    rows = [carry((matrix[3 * i], matrix[3 * i + 1], matrix[3 * i + 2])) for i in range(3)]
    (a, d, g), (b, e, h), (c, f, l) = (carry((rows[0][j], rows[1][j], rows[2][j])) for j in range(3))
    return a, b, c, d, e, f, g, h, l
