"""Variations: small deviations of all variables from a steady motion, by those that are independent.

With the independent coordinates s, the independent speeds v, the states z and the inputs r, of a system with the
constraints phi(q, r) = 0 on positions and ``psi(q, u, r) = 0`` on velocities, whose derivatives are taken along the
motion:

    dq = P ds + P_r dr                 from  phi_q dq + phi_r dr = 0
    du = Z dv + Y ds + Y_r dr          from  psi_u du + psi_q dq + psi_r dr = 0
    ds' = (k_q dq + k_u du + k_r dr)_s from the kinematics  q' = k(q, u)

The dependent variables are found by implicit differentiation, so that the linear equations are exact.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from symbody.dynamics.equations.equations import Equations
from symbody.errors import ConstraintError
from symbody.symbolic import (
    Expr,
    Matrix,
    cost,
    number,
    time_derivative,
    zeros,
)
from symbody.symbolic.given.arguments import brief, counted

from .dependent_columns import Pivots, dependent_columns, solved
from .nonlinear_slopes import slopes_of, velocity_level
from .reference_motion import ReferenceMotion

__all__ = ["Columns", "Variation", "below", "beside", "explicit", "picked", "variation"]


@dataclass(frozen=True)
class Columns:
    """The columns of variations: s, v, z, r, and the rates v'.

    Attributes:
        coordinates: the independent coordinates s.
        speeds: the independent speeds v.
        states: the states z beside the mechanics.
        inputs: the inputs r, each before its rate, if this is an input, too.
    """

    coordinates: tuple[Expr, ...]
    speeds: tuple[Expr, ...]
    states: tuple[Expr, ...]
    inputs: tuple[Expr, ...]

    @property
    def variables(self) -> tuple[Expr, ...]:
        """The state x = (s, v, z)."""
        return *self.coordinates, *self.speeds, *self.states

    @property
    def count(self) -> int:
        """The number of columns."""
        return len(self.variables) + len(self.inputs) + len(self.speeds)

    def spread(self, blocks: Mapping[str, Matrix], rows: int) -> Matrix:
        """Return a matrix of all columns from blocks by the letters s, v, z, r, a; others are zero."""
        kinds = {
            "s": self.coordinates,
            "v": self.speeds,
            "z": self.states,
            "r": self.inputs,
            "a": self.speeds,
        }
        return beside(*(blocks.get(kind) or zeros(rows, len(names)) for kind, names in kinds.items()))


@dataclass(frozen=True, eq=False)
class Variation:
    """How the variables deviate, as matrices of one row per variable, with the columns ``(s, v, z, r, v')``.

    Attributes:
        columns: the independent variables.
        q: the coordinates.
        u: the speeds.
        a: the accelerations.
        rates: the rates of the independent coordinates.
        pivots: the independent constraints, and the dependent speeds.
    """

    columns: Columns
    q: Matrix
    u: Matrix
    a: Matrix
    rates: Matrix
    pivots: Pivots


def variation(
    eqs: Equations,
    motion: ReferenceMotion,
    inputs: tuple[Expr, ...],
    chosen: Sequence[Expr],
    preferred: Sequence[Expr] = (),
) -> Variation:
    """Return how all variables follow the independent ones near a motion.

    Args:
        eqs: the equations of motion.
        motion: the motion.
        inputs: the inputs.
        chosen: the coordinates and speeds that shall be independent.
        preferred: the coordinates whose rates are better independent than others.

    Raises:
        ConstraintError: the constraints don't determine the other variables, or the position is singular.
    """
    P, P_r, dependent = _positions(eqs, motion, inputs, chosen)
    Z, Y, Y_r, pivots = _velocities(eqs, motion, inputs, chosen, preferred, (P, P_r), dependent)
    s = [k for k in range(len(eqs.coordinates)) if k not in dependent]
    v = [k for k in range(len(eqs.speeds)) if k not in pivots.columns]
    columns = Columns(
        tuple(eqs.coordinates[k] for k in s), tuple(motion.axes.names[k] for k in v), eqs.states, inputs
    )
    Z, Y, Y_r = _along_fixed_axes(eqs, motion, (Z, Y, Y_r), (P, P_r))
    N, n = len(eqs.coordinates), len(eqs.speeds)
    q = columns.spread({"s": P, "r": P_r}, N)
    u = columns.spread({"s": Y, "v": Z, "r": Y_r}, n)
    rates = _rates(eqs, motion, columns, q, u)
    moved = {"s": _rate(motion, Y), "v": _rate(motion, Z), "a": Z}
    moved["r"] = _rate(motion, Y_r) + _shifted(Y_r, inputs)
    a = columns.spread(moved, n) + Y @ rates
    return Variation(columns, q, u, a, rates, pivots)


def _positions(
    eqs: Equations, motion: ReferenceMotion, inputs: Sequence[Expr], chosen: Sequence[Expr]
) -> tuple[Matrix, Matrix, tuple[int, ...]]:
    """Return P and P_r, and the places of the dependent coordinates."""
    system, q = eqs.system, eqs.coordinates
    phi = (*system.position_constraints, *system.eliminated_constraints)
    slopes = motion.matrix(slopes_of(phi, [*q, *inputs]))
    A, B = slopes[:, : len(q)], slopes[:, len(q) :]
    allowed = [k for k, each in enumerate(q) if each not in chosen]
    pivots = dependent_columns(A, allowed, lambda i, k: (*_doubt(A[i, k], motion), -k))
    _check_rank(A, slopes_of(phi, q), pivots, q, chosen)
    P, P_r = explicit(A, B, pivots)
    return P, P_r, pivots.columns


def _velocities(
    eqs: Equations,
    motion: ReferenceMotion,
    inputs: Sequence[Expr],
    chosen: Sequence[Expr],
    preferred: Sequence[Expr],
    along: tuple[Matrix, Matrix],
    dependent: Sequence[int],
) -> tuple[Matrix, Matrix, Matrix, Pivots]:
    """Return Z, Y and Y_r, and the places of the dependent speeds: rates of dependent coordinates, if possible.

    Args:
        eqs: the equations of motion.
        motion: the motion.
        inputs: the inputs.
        chosen: the coordinates and speeds that shall be independent.
        preferred: the coordinates whose rates are better independent than others.
        along: P and P_r.
        dependent: the places of the dependent coordinates.
    """
    q, u, (P, P_r) = eqs.coordinates, eqs.speeds, along
    psi = velocity_level(eqs)
    general = slopes_of(psi, [*u, *q, *inputs])
    slopes = motion.matrix(general)
    A, B, C = slopes[:, : len(u)], slopes[:, len(u) : len(u) + len(q)], slopes[:, len(u) + len(q) :]
    A, B = motion.axes.columns(A), B + A @ _turned_with(motion, q)
    follow = {time_derivative(q[k]) for k in dependent}
    stay = {time_derivative(each) for each in chosen}
    allowed = [k for k, each in enumerate(u) if each not in chosen]

    stay |= {time_derivative(each) for each in preferred}

    def rank(i: int, k: int) -> tuple[bool, bool, bool, int, int]:
        return u[k] not in follow, u[k] in stay, *_doubt(A[i, k], motion), -k

    pivots = dependent_columns(A, allowed, rank)
    _check_rank(A, general[:, : len(u)], pivots, u, chosen)
    Z, rest = explicit(A, beside(B @ P, B @ P_r + C), pivots)
    return Z, rest[:, : P.columns], rest[:, P.columns :], pivots


def _turned_with(motion: ReferenceMotion, q: Sequence[Expr]) -> Matrix:
    """Return how the speeds u change with the coordinates at constant speeds along axes that turn."""
    shift, heading = motion.axes.shift, motion.axes.heading
    entries = [entry if each is heading else number(0) for entry in shift.entries for each in q]
    return Matrix.from_entries(shift.rows, len(q), entries)


def _along_fixed_axes(
    eqs: Equations,
    motion: ReferenceMotion,
    found: tuple[Matrix, Matrix, Matrix],
    along: tuple[Matrix, Matrix],
) -> tuple[Matrix, Matrix, Matrix]:
    """Return Z, Y and Y_r of the speeds u, given those of speeds along axes that turn.

    Args:
        eqs: the equations of motion.
        motion: the motion.
        found: Z, Y and Y_r.
        along: P and P_r.
    """
    if motion.axes.are_fixed:
        return found
    turned, T = _turned_with(motion, eqs.coordinates), motion.axes.turn
    (Z, Y, Y_r), (P, P_r) = found, along
    return T @ Z, T @ Y + turned @ P, T @ Y_r + turned @ P_r


def _doubt(pivot: Expr, motion: ReferenceMotion) -> tuple[bool, int]:
    """Return what puts pivots in order: those that contain no moving coordinates, then short ones."""
    return bool(motion.varying(pivot)), cost([pivot]).total


def _check_rank(
    A: Matrix, general: Matrix, pivots: Pivots, names: Sequence[Expr], chosen: Sequence[Expr]
) -> None:
    """Check that the constraints determine the dependent variables.

    Args:
        A: the coefficients along the motion.
        general: the coefficients anywhere.
        pivots: what was found.
        names: the variables.
        chosen: those that shall be independent.

    Raises:
        ConstraintError: they don't.
    """
    rank, found = general.rank(), len(pivots.rows)
    if found == rank:
        return
    if A.rank() < rank:
        raise ConstraintError(
            f"linearize: the position is singular: there, {A.rank()} of {rank} independent constraints restrain "
            f"{brief(', '.join(map(str, names)))} independently; expected a position beside it, about which motions "
            "are those of a linear system"
        )
    count = sum(each in chosen for each in names)
    if count > len(names) - rank:
        raise ConstraintError(
            f"linearize, independent: {count} of {brief(', '.join(map(str, names)))}, with "
            f"{counted(rank, 'independent constraint')}; expected at most {len(names) - rank} of them"
        )
    left = ", ".join(str(each) for each in names if each not in chosen)
    raise ConstraintError(
        f"linearize, independent: the constraints don't determine {brief(left)} by the others; choose other "
        "independent coordinates or speeds, or leave independent out"
    )


def explicit(A: Matrix, B: Matrix, pivots: Pivots) -> tuple[Matrix, Matrix]:
    """Return N and R of ``x = N x_i + R y``, the solution of ``A x + B y = 0``."""
    independent = [k for k in range(A.columns) if k not in pivots.columns]
    known = Matrix.from_entries(
        A.rows,
        len(independent) + B.columns,
        [entry for i in range(A.rows) for entry in (*(A[i, k] for k in independent), *B.row(i))],
    )
    dependent = dict(zip(pivots.columns, solved(A, pivots, -known).tolist(), strict=True))
    width = known.columns
    units = {k: [number(int(j == place)) for j in range(width)] for place, k in enumerate(independent)}
    rows = [dependent.get(k) or units[k] for k in range(A.columns)] if width else []
    whole = Matrix.from_entries(A.columns, width, [entry for row in rows for entry in row])
    return whole[:, : len(independent)], whole[:, len(independent) :]


def _rates(eqs: Equations, motion: ReferenceMotion, columns: Columns, q: Matrix, u: Matrix) -> Matrix:
    """Return the rates of the independent coordinates, ``(k_q dq + k_u du + k_r dr)_s``.

    Args:
        eqs: the equations of motion.
        motion: the motion.
        columns: the independent variables.
        q: the deviations of the coordinates.
        u: those of the speeds.
    """
    kinematics = [eqs.kinematics[time_derivative(each)] for each in columns.coordinates]
    slopes = motion.matrix(slopes_of(kinematics, [*eqs.coordinates, *eqs.speeds, *columns.inputs]))
    N, n = len(eqs.coordinates), len(eqs.speeds)
    direct = columns.spread({"r": slopes[:, N + n :]}, len(kinematics))
    return slopes[:, :N] @ q + slopes[:, N : N + n] @ u + direct


def _rate(motion: ReferenceMotion, matrix: Matrix) -> Matrix:
    return Matrix.from_entries(matrix.rows, matrix.columns, motion.rate(matrix.entries))


def _shifted(matrix: Matrix, inputs: Sequence[Expr]) -> Matrix:
    """Return the coefficients of the inputs where those of their rates are given."""
    places = {r: k for k, r in enumerate(inputs)}
    columns = {k: places[time_derivative(r)] for k, r in enumerate(inputs) if time_derivative(r) in places}
    entries = [number(0)] * len(matrix.entries)
    for k, j in columns.items():
        for i in range(matrix.rows):
            entries[i * matrix.columns + j] = matrix[i, k]
    return Matrix.from_entries(matrix.rows, matrix.columns, entries)


def beside(*blocks: Matrix) -> Matrix:
    """Return matrices of as many rows beside each other."""
    rows = blocks[0].rows
    entries = [entry for i in range(rows) for block in blocks for entry in block.row(i)]
    return Matrix.from_entries(rows, sum(block.columns for block in blocks), entries)


def below(*blocks: Matrix) -> Matrix:
    """Return matrices of as many columns below each other."""
    entries = [entry for block in blocks for entry in block.entries]
    return Matrix.from_entries(sum(block.rows for block in blocks), blocks[0].columns, entries)


def picked(matrix: Matrix, rows: Sequence[int] | None, columns: Sequence[int] | None = None) -> Matrix:
    """Return a matrix of some rows and columns; of all, if none are named."""
    i = range(matrix.rows) if rows is None else rows
    j = range(matrix.columns) if columns is None else columns
    return Matrix.from_entries(len(i), len(j), [matrix[a, b] for a in i for b in j])
