"""Rotation about a principal axis: x, y or z.

The axis is the same in both frames, and so is its column of the field of accelerations (`turning.py`). If the parent's
field is known, the column is taken from there. Most of the child's angular acceleration and field follow from it.
Matrices change in a plane only.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import final

from symbody.geometry.component.triple import NULL, Rate, Triple, is_null, rates
from symbody.geometry.component.turning import Column, Nine, Turning, nine
from symbody.geometry.given.angle import substituted
from symbody.geometry.motion.frame_motion import FrameMotion, Substitution, Symmetric
from symbody.symbolic import Expr, add3, cos, cross3, number, rotate3, rotate_back3, sin

AXES = "XYZ"

_PLACES = number(0), number(1), number(2)
"""The axes as expressions."""


@final
class Rotation(FrameMotion):
    """A rotation about the x (0), y (1) or z (2) axis."""

    tag = b"rotation"

    def __init__(self, axis: int, angle: Expr) -> None:
        self.axis = self.turn_axis = axis
        self.angle = self.turn_angle = angle

    @property
    def variables(self) -> tuple[Expr, ...]:
        return _PLACES[self.axis], self.angle

    def to_parent(self, v: Triple) -> Triple:
        return rotate3(self.axis, self.angle, v)

    def to_child(self, v: Triple) -> Triple:
        return rotate_back3(self.axis, self.angle, v)

    def spin(self, rate: Rate) -> Triple:
        (turning,) = rate((self.angle,))
        return along(self.axis, turning)

    def inverse(self) -> tuple[FrameMotion, ...]:
        return (Rotation(self.axis, -self.angle),)

    def subs(self, substitution: Substitution) -> FrameMotion:
        return Rotation(self.axis, substituted(self.angle, substitution))

    def rewritten(self, variables: Sequence[Expr]) -> FrameMotion:
        return Rotation(self.axis, variables[1])

    def __repr__(self) -> str:
        return f'rotate("{AXES[self.axis]}", {self.angle})'

    def in_latex(self, variables: Sequence[str]) -> str:
        return rf"\mathrm{{Rot}}_{{{AXES[self.axis].lower()}}}\left({variables[1]}\right)"

    def merged(self, following: FrameMotion) -> FrameMotion | None:
        if type(following) is Rotation and following.axis == self.axis:
            return Rotation(self.axis, self.angle + following.angle)
        return None

    @property
    def is_identity(self) -> bool:
        return self.angle.is_zero

    # --- shorter ways ---

    def child_turning(self, parent: Turning, rate: Rate) -> Turning:
        spin = self.spin(rate)
        velocity, angular = add3(self.to_child(parent.velocity), spin), rates(spin, rate)
        if parent.has_field and not is_null(spin):
            return self._turned_by_column(parent, velocity, angular)
        acceleration = add3(self.to_child(parent.acceleration), angular)
        acceleration = add3(acceleration, cross3(velocity, spin))
        if parent.has_field and self._exchanges_axes:
            return Turning(velocity, acceleration, field=self.matrix_to_child(parent.field))
        return Turning(velocity, acceleration)

    def _turned_by_column(self, parent: Turning, velocity: Triple, angular: Triple) -> Turning:
        """Turn by the column of the axis: ``al_j = F_ik - w_i w_k`` and ``al_i = w_j w_k - F_jk``."""
        k, F = self.axis, parent.field
        i, j = (k + 1) % 3, (k + 2) % 3
        column = self.to_child((F[k], F[3 + k], F[6 + k]))
        acceleration = [parent.acceleration[k] + angular[k]] * 3
        acceleration[i] = velocity[j] * velocity[k] - column[j]
        acceleration[j] = column[i] - velocity[i] * velocity[k]
        x, y, z = acceleration
        return Turning(velocity, (x, y, z), column=Column(k, column))

    @property
    def _exchanges_axes(self) -> bool:
        """Whether the rotation is by a multiple of a right angle."""
        return cos(self.angle).is_number and sin(self.angle).is_number

    def symmetric_to_parent(self, matrix: Symmetric) -> Symmetric:
        """Turn in the plane (i, j): with ``p = c (J_ii - J_jj) - 2 s J_ij`` its entries change by c p and s p."""
        axis, c, s = self.axis, cos(self.angle), sin(self.angle)
        i, j = (axis + 1) % 3, (axis + 2) % 3
        entries = list(matrix)
        mixed = 3 + axis
        p = c * (matrix[i] - matrix[j]) - s * (2 * matrix[mixed])
        cp = c * p
        entries[i], entries[j], entries[mixed] = matrix[j] + cp, matrix[i] - cp, matrix[mixed] + s * p
        entries[3 + j], entries[3 + i] = (
            c * matrix[3 + j] - s * matrix[3 + i],
            s * matrix[3 + j] + c * matrix[3 + i],
        )
        return entries[0], entries[1], entries[2], entries[3], entries[4], entries[5]

    def matrix_to_parent(self, matrix: Nine) -> Nine:
        """Turn in the plane (i, j), as a symmetric matrix turns; the difference of B_ij and B_ji stays."""
        k, c, s = self.axis, cos(self.angle), sin(self.angle)
        i, j = (k + 1) % 3, (k + 2) % 3
        turned = list(matrix)
        ii, jj, ij, ji, ik, jk, ki, kj = (
            3 * a + b for a, b in ((i, i), (j, j), (i, j), (j, i), (i, k), (j, k), (k, i), (k, j))
        )
        p = c * (matrix[ii] - matrix[jj]) - s * (matrix[ij] + matrix[ji])
        cp, sp = c * p, s * p
        turned[ii], turned[jj] = matrix[jj] + cp, matrix[ii] - cp
        turned[ij], turned[ji] = matrix[ij] + sp, matrix[ji] + sp
        for a, b in ((ik, jk), (ki, kj)):
            turned[a], turned[b] = c * matrix[a] - s * matrix[b], s * matrix[a] + c * matrix[b]
        return nine(turned)


def along(axis: int, value: Expr) -> Triple:
    """Return the vector of the given length along a principal axis."""
    zero = NULL[0]
    return (value, zero, zero) if axis == 0 else (zero, value, zero) if axis == 1 else (zero, zero, value)
