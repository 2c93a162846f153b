"""Frames given as bare matrices: natural coordinates, or the results of another calculation."""

from __future__ import annotations

from collections.abc import Sequence
from typing import final

from symbody.geometry.component.triple import NULL, Rate, Triple, rates, triple
from symbody.symbolic import Expr, common_parameters, cross3, dot3, matvec3, sub3, substitute
from symbody.symbolic.expression.latex_layout import bmatrix

from .frame_motion import FrameMotion, Rows, Substitution


@final
class Placement(FrameMotion):
    """A rotation matrix (by rows) and a displacement, whose entries may be unknowns (natural coordinates).

    If the rows aren't orthonormal by themselves, the motion isn't rigid, and constraints must make them orthonormal.
    """

    tag = b"placement"

    def __init__(self, rows: Rows, displacement: Triple) -> None:
        self.rows = rows
        self._displacement = displacement
        self.is_rigid = is_rotation(rows)

    @property
    def variables(self) -> tuple[Expr, ...]:
        return *self.rows[0], *self.rows[1], *self.rows[2], *self._displacement

    @property
    def displacement(self) -> Triple:
        return self._displacement

    def to_parent(self, v: Triple) -> Triple:
        x, y, z = self.rows
        return matvec3((*x, *y, *z), v)

    def to_child(self, v: Triple) -> Triple:
        """Use the transpose as the inverse: exact where the constraints hold."""
        x, y, z = transposed(self.rows)
        return matvec3((*x, *y, *z), v)

    def spin(self, rate: Rate) -> Triple:
        """Return the axial vector of ``R^T dR/dt``."""
        return axial_rate(self.rows, rate)

    def inverse(self) -> tuple[FrameMotion, ...]:
        return (self.inverted(),)

    def inverted(self) -> Placement:
        """Return the one placement that brings the child back."""
        return Placement(transposed(self.rows), sub3(NULL, self.to_child(self._displacement)))

    def __repr__(self) -> str:
        rows = [[*row, place] for row, place in zip(self.rows, self._displacement, strict=True)]
        return f"Frame({[*rows, [0, 0, 0, 1]]})"

    def in_latex(self, variables: Sequence[str]) -> str:
        rows = ((*variables[3 * k : 3 * k + 3], variables[9 + k]) for k in range(3))
        return bmatrix([entry for row in (*rows, "0001") for entry in row], 4)

    def subs(self, substitution: Substitution) -> Placement:
        return self.rewritten(substitute(self.variables, substitution))

    def rewritten(self, variables: Sequence[Expr]) -> Placement:
        a, b, c, d, e, f, g, h, i, x, y, z = variables
        return Placement(((a, b, c), (d, e, f), (g, h, i)), (x, y, z))


def transposed(rows: Rows) -> Rows:
    """Return the columns."""
    (a, b, c), (d, e, f), (g, h, i) = rows
    return (a, d, g), (b, e, h), (c, f, i)


def axial_rate(rows: Rows, rate: Rate) -> Triple:
    """Return the vector of ``R^T dR/dt``: its entries (z, y), (x, z) and (y, x).

    With columns u, v, w of R these are ``w.v'``, ``u.w'`` and ``v.u'``. Parameters that all entries of a column, or of
    its rate, have as a factor are factors of these. Columns are differentiated as they are: where terms of small
    variables are dropped, a column that is made anew has lost those of which its rate consists.
    """
    columns = transposed(rows)
    (p, u), (q, v), (r, w) = map(_parts, columns)
    (p_t, u_t), (q_t, v_t), (r_t, w_t) = (_parts(rates(column, rate)) for column in columns)
    return r * q_t * dot3(w, v_t), p * r_t * dot3(u, w_t), q * p_t * dot3(v, u_t)


def _parts(entries: Triple) -> tuple[Expr, Triple]:
    """Return the parameters that entries have in common, and the entries without them."""
    factor, rest = common_parameters(entries)
    return factor, triple(*rest)


def is_rotation(rows: Rows) -> bool:
    """Return whether the rows are a right-handed orthonormal triad: each is the cross product of the other two."""
    x, y, z = rows
    return cross3(x, y) == z and cross3(y, z) == x and cross3(z, x) == y
