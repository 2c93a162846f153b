"""The balance of forces near a steady motion: the linear equations of motion, without and with multipliers.

The residuals ``R(q, u, u', z, lambda, r)`` are linear in u' and lambda. Along the motion, some of them give the
multipliers; others don't hold these, ``W^T R = 0`` with ``W^T R_lambda = 0``. Their derivatives at constant multipliers
are the linear equations, with the change of the directions of constraints in R_q.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from symbody.dynamics.equations.equations import Equations
from symbody.symbolic import Expr, Matrix, derivation, number, substitute

from .dependent_columns import Pivots, solved
from .nonlinear_slopes import slopes_of
from .reference_motion import ReferenceMotion
from .variation import Variation, explicit

__all__ = ["Balance", "force_balance"]


@dataclass(frozen=True, eq=False)
class Balance:
    """The balance of forces.

    Attributes:
        motion: the motion, with its multipliers.
        forces: ``W^T dR`` at constant multipliers, a row per independent speed, with the columns ``(s, v, z, r, v')``.
        multipliers: the deviations of the multipliers, a row each, with the same columns.
        residuals: ``W^T R`` along the motion, which should vanish.
    """

    motion: ReferenceMotion
    forces: Matrix
    multipliers: Matrix
    residuals: tuple[Expr, ...]


def force_balance(eqs: Equations, motion: ReferenceMotion, vary: Variation) -> Balance:
    """Return the linear balance of forces near a motion.

    Args:
        eqs: the equations of motion.
        motion: the motion.
        vary: how the variables deviate.
    """
    columns, pivots = vary.columns, vary.pivots
    accelerations = motion.at(eqs.accelerations)
    still = all(a.is_zero for a in accelerations)
    with derivation(fresh=True):
        rest = dict.fromkeys(eqs.accelerations, number(0)) if still else {}
        R = substitute(eqs.derived_residuals, rest)
    powers = motion.axes.powers
    R_lambda = powers(motion.matrix(slopes_of(R, eqs.multipliers)))
    known = _with_multipliers(eqs, motion, R, R_lambda, pivots)
    names = [*eqs.coordinates, *eqs.speeds, *columns.states, *columns.inputs]
    slopes = powers(known.matrix(slopes_of(R, names)))
    N, n, k = len(eqs.coordinates), len(eqs.speeds), len(columns.states)
    M = powers(known.matrix(slopes_of(eqs.derived_residuals, eqs.accelerations)))
    direct = columns.spread({"z": slopes[:, N + n : N + n + k], "r": slopes[:, N + n + k :]}, n)
    whole = M @ vary.a + slopes[:, :N] @ vary.q + slopes[:, N : N + n] @ vary.u + direct
    W = _without_multipliers(R_lambda, pivots)
    along = Matrix.column(known.at(eqs.derived_residuals))
    column = powers(along)
    if not motion.axes.are_fixed:
        place = eqs.coordinates.index(motion.axes.heading)
        whole += motion.axes.turned_powers(along) @ vary.q[place : place + 1, :]
    found = solved(R_lambda, Pivots(pivots.columns, pivots.rows), -whole)
    places = {row: i for i, row in enumerate(pivots.rows)}
    nothing = [number(0)] * columns.count
    rows = [found.row(places[i]) if i in places else nothing for i in range(len(eqs.multipliers))]
    multipliers = Matrix.from_entries(len(rows), columns.count, [entry for row in rows for entry in row])
    return Balance(known, W.T @ whole, multipliers, (W.T @ column).entries)


def _with_multipliers(
    eqs: Equations, motion: ReferenceMotion, R: tuple[Expr, ...], R_lambda: Matrix, pivots: Pivots
) -> ReferenceMotion:
    """Return the motion with its multipliers; those of constraints that follow from others are zero.

    Args:
        eqs: the equations of motion.
        motion: the motion, without multipliers.
        R: the residuals.
        R_lambda: their derivatives by the multipliers along the motion.
        pivots: the independent constraints, and the dependent speeds.
    """
    if not eqs.multipliers:
        return motion
    none = dict.fromkeys(eqs.multipliers, number(0))
    rest = motion.axes.powers(Matrix.column([-each for each in motion.at(substitute(R, none))]))
    found = solved(R_lambda, Pivots(pivots.columns, pivots.rows), rest).entries
    values = none | dict(zip((eqs.multipliers[k] for k in pivots.rows), found, strict=True))
    return replace(motion, others={**motion.others, **values})


def _without_multipliers(R_lambda: Matrix, pivots: Pivots) -> Matrix:
    """Return W with ``W^T R_lambda = 0``: the identity in the rows of the independent speeds."""
    transposed = R_lambda.T
    nothing = Matrix.from_entries(transposed.rows, 0, ())
    W, _ = explicit(transposed, nothing, pivots)
    return W
