"""The inertia of an articulated body: of a body that carries others on joints without forces."""

from __future__ import annotations

from typing import NamedTuple

from symbody.geometry.component.triple import NULL, Triple, is_null
from symbody.geometry.component.turning import Nine, nine
from symbody.geometry.motion.frame_motion import FrameMotion, Symmetric
from symbody.symbolic import add3, cross3, matvec3, matvec3_transposed

from .composite import Composite, tensor_times, turned
from .wrench import Wrench


class ArticulatedInertia(NamedTuple):
    """The linear map from the acceleration of a body to the wrench on it: ``n = J al + B a``, ``f = B^T al + C a``.

    The acceleration a is that of the frame's origin. J and C are symmetric [Featherstone 2008, sec. 7.1].
    """

    rotational: Symmetric
    """J"""
    coupling: Nine
    """B"""
    linear: Symmetric
    """C"""

    @classmethod
    def of(cls, body: Composite) -> ArticulatedInertia:
        """Return the inertia of a rigid body: ``B = [h x]``, ``C = m 1``."""
        (x, y, z), m, zero = body.moment, body.mass, NULL[0]
        return cls(body.inertia, (zero, -z, y, z, zero, -x, -y, x, zero), (m, m, m, zero, zero, zero))

    def plus(self, other: ArticulatedInertia) -> ArticulatedInertia:
        """Return both bodies as one."""
        return ArticulatedInertia(
            _sum(self.rotational, other.rotational),
            nine(a + b for a, b in zip(self.coupling, other.coupling, strict=True)),
            _sum(self.linear, other.linear),
        )

    def wrench(self, angular: Triple, linear: Triple) -> Wrench:
        """Return the wrench that gives the body an angular acceleration, and its origin a linear one."""
        force = add3(matvec3_transposed(self.coupling, angular), tensor_times(self.linear, linear))
        return Wrench(force, add3(tensor_times(self.rotational, angular), matvec3(self.coupling, linear)))

    def released(self, needed: Wrench, share: Wrench) -> ArticulatedInertia:
        """Return the inertia that a free joint leaves: ``I - G U^T`` for ``U = I S`` and ``G = U / (S . U)``."""
        (u, v, w), (x, y, z) = needed.moment, needed.force
        (a, b, c), (d, e, f) = share.moment, share.force
        J, B, C = self
        return ArticulatedInertia(
            (J[0] - a * u, J[1] - b * v, J[2] - c * w, J[3] - b * w, J[4] - a * w, J[5] - a * v),
            nine(B[3 * i + j] - r * s for i, r in enumerate((u, v, w)) for j, s in enumerate((d, e, f))),
            (C[0] - d * x, C[1] - e * y, C[2] - f * z, C[3] - e * z, C[4] - d * z, C[5] - d * y),
        )

    def to_parent(self, motion: FrameMotion) -> ArticulatedInertia:
        """Return the inertia as seen from the parent."""
        inertia = ArticulatedInertia(
            turned(self.rotational, motion),
            motion.matrix_to_parent(self.coupling),
            turned(self.linear, motion),
        )
        return inertia if is_null(motion.displacement) else inertia.displaced(motion.displacement)

    def displaced(self, d: Triple) -> ArticulatedInertia:
        """Return the inertia after a displacement d: ``B' = B + [d x] C``, ``J' = J - B [d x] + [d x] B'^T``."""
        columns = [cross3(d, row) for row in _rows(self.linear)]
        coupling = nine(self.coupling[3 * i + j] + columns[j][i] for i in range(3) for j in range(3))
        change = _change(d, self.coupling, coupling)
        return ArticulatedInertia(_sum(self.rotational, change), coupling, self.linear)


def _change(d: Triple, before: Nine, after: Nine) -> Symmetric:
    """Return ``-B [d x] + [d x] B'^T``, which is symmetric, with few products."""
    entries = []
    for k in range(3):
        i, j = (k + 1) % 3, (k + 2) % 3
        ki, kj = (before[3 * k + other] + after[3 * k + other] for other in (i, j))
        entries.append(d[i] * kj - d[j] * ki)
    for k in range(3):
        i, j = (k + 1) % 3, (k + 2) % 3
        mixed = d[k] * (before[4 * i] - after[4 * j])
        entries.append(mixed + (d[j] * after[3 * j + k] - d[i] * before[3 * i + k]))
    return entries[0], entries[1], entries[2], entries[3], entries[4], entries[5]


def _sum(a: Symmetric, b: Symmetric) -> Symmetric:
    x, y, z, u, v, w = (p + q for p, q in zip(a, b, strict=True))
    return x, y, z, u, v, w


def _rows(tensor: Symmetric) -> tuple[Triple, Triple, Triple]:
    xx, yy, zz, yz, xz, xy = tensor
    return (xx, xy, xz), (xy, yy, yz), (xz, yz, zz)
