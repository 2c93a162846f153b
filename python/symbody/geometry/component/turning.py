"""Rotation of frames: angular velocity, angular acceleration, and the field of accelerations that they make.

The field ``F = [al x] + [w x][w x]`` of a frame gives the acceleration of all its points, ``a_Q = a_P + F p_PQ``; it is
built once per frame and used for every offset in it. Its column for an axis e is the relative acceleration of a point
at distance 1 along e.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple, TypeAlias, final

from symbody.symbolic import Expr, number

from .triple import Triple

Nine: TypeAlias = tuple[Expr, Expr, Expr, Expr, Expr, Expr, Expr, Expr, Expr]
"""A 3x3 matrix, row by row."""


def nine(entries: Iterable[Expr]) -> Nine:
    """Return a 3x3 matrix by its entries, row by row."""
    a, b, c, d, e, f, g, h, l = entries
    return a, b, c, d, e, f, g, h, l


class Column(NamedTuple):
    """The column of a field that belongs to an axis: 0, 1 or 2."""

    axis: int
    components: Triple


@final
class Turning:
    """The rotation of a frame: angular velocity and acceleration, and the field that they make.

    Args:
        velocity: the angular velocity.
        acceleration: the angular acceleration.
        column: a column of the field, if it is known.
        field: the field, if it is known.
    """

    def __init__(
        self,
        velocity: Triple,
        acceleration: Triple,
        *,
        column: Column | None = None,
        field: Nine | None = None,
    ) -> None:
        self.velocity = velocity
        self.acceleration = acceleration
        self._column = column
        self._field = field

    @property
    def has_field(self) -> bool:
        """Whether the field has been made."""
        return self._field is not None

    @property
    def field(self) -> Nine:
        """``[al x] + [w x][w x]``."""
        if self._field is None:
            self._field = self._new_field() if self._column is None else self._field_beside(self._column)
        return self._field

    def _new_field(self) -> Nine:
        (x, y, z), (u, v, w) = self.velocity, self.acceleration
        xx, yy, zz, xy, yz, zx = x * x, y * y, z * z, x * y, y * z, z * x
        return -(yy + zz), xy - w, zx + v, xy + w, -(xx + zz), yz - u, zx - v, yz + u, -(xx + yy)

    def _field_beside(self, column: Column) -> Nine:
        """Return the field by one column: ``F_ki = 2 w_k w_i - F_ik``, ``F_jj = F_kk + w_j^2 - w_k^2``."""
        k, known = column
        i, j = (k + 1) % 3, (k + 2) % 3
        w, turn = self.velocity, self.acceleration[k]
        ij, jj, kk, twice = w[i] * w[j], w[j] * w[j], w[k] * w[k], number(2) * w[k]
        rows = [[known[row]] * 3 for row in range(3)]
        rows[k][i], rows[k][j] = twice * w[i] - known[i], twice * w[j] - known[j]
        rows[i][j], rows[j][i] = ij - turn, ij + turn
        rows[i][i], rows[j][j] = -(jj + kk), known[k] + (jj - kk)
        (a, b, c), (d, e, f), (g, h, l) = rows
        return a, b, c, d, e, f, g, h, l


class Accelerated(NamedTuple):
    """The state of the recursion: how the frame turns, and the acceleration of its origin."""

    turning: Turning
    linear: Triple
