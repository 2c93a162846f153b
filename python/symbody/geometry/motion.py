"""Elementary motions: the links of which a frame is the chain."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping
from functools import cached_property
from hashlib import blake2b
from typing import ClassVar, final

from symbody.symbolic import Expr, cos, number, rotate3, rotate_back3, scale3, sin

from .angle import substituted
from .triple import NULL, Rate, Scalar, Triple, is_null, rates

Substitution = Mapping[Expr, Scalar]
Rows = tuple[Triple, Triple, Triple]
"""A 3x3 matrix by rows."""

AXES = "XYZ"


class Motion(ABC):
    """How a frame (the child) is placed in another one (the parent).

    A vector's components go up, from the child's axes to the parent's, by ``to_parent``, and down by ``to_child``.
    """

    tag: ClassVar[bytes]
    is_rigid: bool = True
    """Whether the axes are orthonormal whatever the values of the variables."""
    rotates: bool = True

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
    def inverse(self) -> tuple[Motion, ...]:
        """Return the motions that bring the child back."""

    @abstractmethod
    def subs(self, substitution: Substitution) -> Motion:
        """Return the motion with expressions put in the place of others."""

    @abstractmethod
    def __repr__(self) -> str:
        """Return what makes the motion, as a user writes it."""

    def merged(self, following: Motion) -> Motion | None:
        """Return the one elementary motion that this and the following one make, or None."""
        del following
        return None

    @property
    def is_identity(self) -> bool:
        """Whether nothing moves."""
        return False

    def drift(self, rate: Rate) -> Triple:
        """Return the velocity of the child's origin in the parent, in the parent's axes."""
        return rates(self.displacement, rate)

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
        """Whether the motion is no motion at all: the child is fixed in the parent."""
        return not any(variable.depends_on_time for variable in self.variables)


@final
class Translation(Motion):
    """A displacement along the parent's axes."""

    tag = b"translation"
    rotates = False

    def __init__(self, displacement: Triple) -> None:
        self._displacement = displacement

    @property
    def variables(self) -> tuple[Expr, ...]:
        return self._displacement

    @property
    def displacement(self) -> Triple:
        return self._displacement

    def to_parent(self, v: Triple) -> Triple:
        return v

    def to_child(self, v: Triple) -> Triple:
        return v

    def spin(self, rate: Rate) -> Triple:
        del rate
        return NULL

    def inverse(self) -> tuple[Motion, ...]:
        return (Translation(scale3(number(-1), self._displacement)),)

    def subs(self, substitution: Substitution) -> Motion:
        x, y, z = self._displacement
        return Translation((x.subs(substitution), y.subs(substitution), z.subs(substitution)))

    def __repr__(self) -> str:
        return f"translate({', '.join(map(str, self._displacement))})"

    def merged(self, following: Motion) -> Motion | None:
        """Merge only what cancels: any other sum would hide the frame in between from those who share it."""
        if not isinstance(following, Translation):
            return None
        total = tuple(a + b for a, b in zip(self._displacement, following.displacement, strict=True))
        return None if any(not component.is_zero for component in total) else Translation(NULL)

    @property
    def is_identity(self) -> bool:
        return is_null(self._displacement)


@final
class Rotation(Motion):
    """A rotation about the x (0), y (1) or z (2) axis."""

    tag = b"rotation"

    def __init__(self, axis: int, angle: Expr) -> None:
        self.axis = axis
        self.angle = angle

    @property
    def variables(self) -> tuple[Expr, ...]:
        return number(self.axis), self.angle

    def to_parent(self, v: Triple) -> Triple:
        return rotate3(self.axis, cos(self.angle), sin(self.angle), v)

    def to_child(self, v: Triple) -> Triple:
        return rotate_back3(self.axis, cos(self.angle), sin(self.angle), v)

    def spin(self, rate: Rate) -> Triple:
        (turning,) = rate((self.angle,))
        return along(self.axis, turning)

    def inverse(self) -> tuple[Motion, ...]:
        return (Rotation(self.axis, -self.angle),)

    def subs(self, substitution: Substitution) -> Motion:
        return Rotation(self.axis, substituted(self.angle, substitution))

    def __repr__(self) -> str:
        return f'rotate("{AXES[self.axis]}", {self.angle})'

    def merged(self, following: Motion) -> Motion | None:
        if isinstance(following, Rotation) and following.axis == self.axis:
            return Rotation(self.axis, self.angle + following.angle)
        return None

    @property
    def is_identity(self) -> bool:
        return self.angle.is_zero


def along(axis: int, value: Expr) -> Triple:
    """Return the vector of the given length along a principal axis."""
    zero = NULL[0]
    return (value, zero, zero) if axis == 0 else (zero, value, zero) if axis == 1 else (zero, zero, value)
