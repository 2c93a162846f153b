"""A rigid body seen from a frame: one body, or several that are frozen together."""

from __future__ import annotations

from typing import NamedTuple

from symbody.geometry.component.triple import NULL, Triple, is_null
from symbody.geometry.motion.frame_motion import FrameMotion, Symmetric
from symbody.multibody import Body
from symbody.symbolic import Expr, add3, cross3, matvec3, number, scale3, sub3

from .wrench import Wrench

_ZERO = number(0)
_NO_INERTIA: Symmetric = (_ZERO, _ZERO, _ZERO, _ZERO, _ZERO, _ZERO)


class Composite(NamedTuple):
    """A rigid body seen from a frame."""

    mass: Expr
    moment: Triple
    """The first moment, mass times position of the centre of mass."""
    inertia: Symmetric
    """About the frame's origin."""

    def plus(self, other: Composite) -> Composite:
        """Return both bodies as one."""
        a, b = self.inertia, other.inertia
        x, y, z = add3((a[0], a[1], a[2]), (b[0], b[1], b[2]))
        u, v, w = add3((a[3], a[4], a[5]), (b[3], b[4], b[5]))
        return Composite(self.mass + other.mass, add3(self.moment, other.moment), (x, y, z, u, v, w))

    def minus(self, other: Composite) -> Composite:
        """Return the rest of the body without another one."""
        x, y, z, u, v, w = (a - b for a, b in zip(self.inertia, other.inertia, strict=True))
        return Composite(self.mass - other.mass, sub3(self.moment, other.moment), (x, y, z, u, v, w))

    @property
    def is_numeric(self) -> bool:
        """Whether all its entries are numbers."""
        return all(entry.is_constant for entry in (self.mass, *self.moment, *self.inertia))

    @property
    def is_null(self) -> bool:
        """Whether it has neither mass nor inertia."""
        return all(entry.is_zero for entry in (self.mass, *self.moment, *self.inertia))

    @property
    def second_moments(self) -> Triple:
        """The second moments of mass along the axes: the integrals of x^2, y^2 and z^2."""
        xx, yy, zz, *_ = self.inertia
        half = number(1) / 2
        return half * (yy + zz - xx), half * (zz + xx - yy), half * (xx + yy - zz)

    def to_parent(self, motion: FrameMotion) -> Composite:
        """Return the body as seen from the parent."""
        body = Composite(self.mass, motion.to_parent(self.moment), turned(self.inertia, motion))
        return body if is_null(motion.displacement) else body.displaced(motion.displacement)

    def displaced(self, d: Triple) -> Composite:
        """Return the body after a displacement d.

        With the new moment ``h' = h + m d`` the inertia grows by ``(d . s) 1 - sym(d s)`` for ``s = h + h'``. The form
        has few products.
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


def tensor_times(tensor: Symmetric, v: Triple) -> Triple:
    """Return the product of a symmetric matrix and a vector."""
    xx, yy, zz, yz, xz, xy = tensor
    return matvec3((xx, xy, xz, xy, yy, yz, xz, yz, zz), v)


def turned(tensor: Symmetric, motion: FrameMotion) -> Symmetric:
    """Return ``R J R^T``; zero stays zero."""
    return tensor if all(entry.is_zero for entry in tensor) else motion.symmetric_to_parent(tensor)


def composite(body: Body) -> Composite:
    """Return a body as seen from its own frame."""
    (xx, yy, zz), (yz, xz, xy) = body.moments, body.products
    return Composite(body.mass, NULL, (xx, yy, zz, -yz, -xz, -xy))


def particle(mass: Expr, place: Triple) -> Composite:
    """Return a mass at a place."""
    return Composite(mass, NULL, _NO_INERTIA).displaced(place)


def rotor(inertia: Symmetric) -> Composite:
    """Return a body that only resists rotation: it has inertia, and no mass."""
    return Composite(_ZERO, NULL, inertia)
