"""The inertia of an articulated body: of a body that carries others on joints without forces."""

from __future__ import annotations

from typing import NamedTuple, TypeAlias

from symbody.dynamics.inertia.composite import Composite, Tensor, tensor_times, turned_tensor
from symbody.dynamics.inertia.wrench import Wrench
from symbody.geometry.motion import Motion, Rotation
from symbody.geometry.triple import NULL, Triple, is_null
from symbody.symbolic import Expr, add3, cos, cross3, matvec3, matvec3_transposed, sin

Nine: TypeAlias = tuple[Expr, ...]
"""A 3x3 matrix, row after row."""


class ArticulatedInertia(NamedTuple):
    """What gives the wrench on a body by its acceleration: ``n = J al + B a``, ``f = B^T al + C a``.

    The acceleration a is that of the frame's origin; J and C are symmetric.
    """

    rotational: Tensor
    """J"""
    coupling: Nine
    """B"""
    linear: Tensor
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
            tuple(a + b for a, b in zip(self.coupling, other.coupling, strict=True)),
            _sum(self.linear, other.linear),
        )

    def wrench(self, angular: Triple, linear: Triple) -> Wrench:
        """Return the wrench that gives the body an angular acceleration, and its origin a linear one."""
        force = add3(matvec3_transposed(self.coupling, angular), tensor_times(self.linear, linear))
        return Wrench(force, add3(tensor_times(self.rotational, angular), matvec3(self.coupling, linear)))

    def released(self, needed: Wrench, share: Wrench) -> ArticulatedInertia:
        """Return what is left where one joint gives way: ``I - G U^T`` for ``U = I S`` and ``G = U / (S . U)``."""
        (u, v, w), (x, y, z) = needed.moment, needed.force
        (a, b, c), (d, e, f) = share.moment, share.force
        J, B, C = self
        return ArticulatedInertia(
            (J[0] - a * u, J[1] - b * v, J[2] - c * w, J[3] - b * w, J[4] - a * w, J[5] - a * v),
            tuple(B[3 * i + j] - r * s for i, r in enumerate((u, v, w)) for j, s in enumerate((d, e, f))),
            (C[0] - d * x, C[1] - e * y, C[2] - f * z, C[3] - e * z, C[4] - d * z, C[5] - d * y),
        )

    def to_parent(self, motion: Motion) -> ArticulatedInertia:
        """Return the inertia as seen from the parent."""
        turned = ArticulatedInertia(
            turned_tensor(self.rotational, motion),
            _turned(self.coupling, motion),
            turned_tensor(self.linear, motion),
        )
        return turned if is_null(motion.displacement) else turned.displaced(motion.displacement)

    def displaced(self, d: Triple) -> ArticulatedInertia:
        """Return the inertia after a displacement d: ``B' = B + [d x] C``, ``J' = J - B [d x] + [d x] B'^T``."""
        columns = [cross3(d, row) for row in _rows(self.linear)]
        coupling = tuple(self.coupling[3 * i + j] + columns[j][i] for i in range(3) for j in range(3))
        change = _change(d, self.coupling, coupling)
        return ArticulatedInertia(_sum(self.rotational, change), coupling, self.linear)


def _change(d: Triple, before: Nine, after: Nine) -> Tensor:
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


def _sum(a: Tensor, b: Tensor) -> Tensor:
    x, y, z, u, v, w = (p + q for p, q in zip(a, b, strict=True))
    return x, y, z, u, v, w


def _rows(tensor: Tensor) -> tuple[Triple, Triple, Triple]:
    xx, yy, zz, yz, xz, xy = tensor
    return (xx, xy, xz), (xy, yy, yz), (xz, yz, zz)


def _turned(matrix: Nine, motion: Motion) -> Nine:
    """Return ``R B R^T``."""
    if not motion.rotates:
        return matrix
    if isinstance(motion, Rotation):
        return _turned_about(matrix, motion.axis, cos(motion.angle), sin(motion.angle))
    rows = [motion.to_parent((matrix[3 * i], matrix[3 * i + 1], matrix[3 * i + 2])) for i in range(3)]
    columns = [motion.to_parent((rows[0][j], rows[1][j], rows[2][j])) for j in range(3)]
    return tuple(columns[j][i] for i in range(3) for j in range(3))


def _turned_about(matrix: Nine, k: int, c: Expr, s: Expr) -> Nine:
    """Turn in the plane (i, j), as a symmetric matrix turns; the difference of B_ij and B_ji stays."""
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
    return tuple(turned)
