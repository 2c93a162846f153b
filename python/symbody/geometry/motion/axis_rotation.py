"""Rotation about an axis that is not one of the principal ones."""

from __future__ import annotations

from collections.abc import Sequence
from typing import final

from symbody.deferred import cached_property
from symbody.geometry.component.triple import Rate, Triple, is_null, rates
from symbody.geometry.given.angle import substituted
from symbody.geometry.motion.principal_rotation import Rotation
from symbody.symbolic import Expr, add3, cos, cross3, current_derivation, dot3, matvec3, scale3, sin

from .frame_motion import FrameMotion, Substitution


@final
class AxisRotation(FrameMotion):
    """A rotation about a unit vector e: ``R = cos(a) 1 + sin(a) [e x] + (1 - cos(a)) e e^T`` (Rodrigues)."""

    tag = b"axis rotation"

    def __init__(self, axis: Triple, angle: Expr) -> None:
        self.axis = axis
        self.angle = angle

    @property
    def variables(self) -> tuple[Expr, ...]:
        return *self.axis, self.angle

    @property
    def _entries(self) -> tuple[Expr, ...]:
        """The entries of the rotation matrix, as far as the derivation in progress keeps small variables."""
        current = current_derivation()
        order = None if current is None else current.order
        if order not in self._by_order:
            self._by_order[order] = self._made()
        return self._by_order[order]

    @cached_property
    def _by_order(self) -> dict[int | None, tuple[Expr, ...]]:
        return {}

    def _made(self) -> tuple[Expr, ...]:
        (x, y, z), c, s = self.axis, cos(self.angle), sin(self.angle)
        u, v, w = scale3(1 - c, self.axis)
        return (
            c + u * x, u * y - s * z, u * z + s * y,
            v * x + s * z, c + v * y, v * z - s * x,
            w * x - s * y, w * y + s * x, c + w * z,
        )  # fmt: skip

    def to_parent(self, v: Triple) -> Triple:
        return matvec3(self._entries, v)

    def to_child(self, v: Triple) -> Triple:
        r = self._entries
        return matvec3((r[0], r[3], r[6], r[1], r[4], r[7], r[2], r[5], r[8]), v)

    def spin(self, rate: Rate) -> Triple:
        """Return ``a' e + sin(a) e' - (1 - cos(a)) e x e'``, in the child's axes."""
        (speed,) = rate((self.angle,))
        spin, turning = scale3(speed, self.axis), rates(self.axis, rate)
        if is_null(turning):
            return spin
        spin = add3(spin, scale3(sin(self.angle), turning))
        return add3(spin, scale3(cos(self.angle) - 1, cross3(self.axis, turning)))

    def inverse(self) -> tuple[FrameMotion, ...]:
        return (AxisRotation(self.axis, -self.angle),)

    def subs(self, substitution: Substitution) -> FrameMotion:
        x, y, z = self.axis
        axis = x.subs(substitution), y.subs(substitution), z.subs(substitution)
        return rotation_about(axis, substituted(self.angle, substitution))

    def rewritten(self, variables: Sequence[Expr]) -> FrameMotion:
        x, y, z, angle = variables
        return AxisRotation((x, y, z), angle)

    def __repr__(self) -> str:
        return f"rotate(({', '.join(map(str, self.axis))}), {self.angle})"

    def in_latex(self, variables: Sequence[str]) -> str:
        *axis, angle = variables
        return rf"\mathrm{{Rot}}_{{\left({', '.join(axis)}\right)}}\left({angle}\right)"

    def merged(self, following: FrameMotion) -> FrameMotion | None:
        if isinstance(following, AxisRotation) and following.axis == self.axis:
            return AxisRotation(self.axis, self.angle + following.angle)
        return None

    @property
    def is_identity(self) -> bool:
        return self.angle.is_zero


def rotation_about(axis: Triple, angle: Expr) -> FrameMotion:
    """Return the rotation about a unit vector, as one about a principal axis if it is along it."""
    for k, component in enumerate(axis):
        if (component * component - 1).is_zero:
            return Rotation(k, component * angle)
    return AxisRotation(axis, angle)


def is_unit(axis: Triple) -> bool:
    """Return whether a vector has length one, whatever its variables."""
    return (dot3(axis, axis) - 1).is_zero
