"""The variations of accelerations and multipliers, by implicit differentiation of the equations of motion.

Along a motion, ``R(x, p, a, lambda) = M a + h - A^T lambda = 0`` and ``A a + c = 0``. Their derivatives along
the sensitivities S are

    [ M   A^T ] [    da    ]     [ R_x S + R_p           ]
    [ A    0  ] [ -dlambda ] = - [ (A a + c)_x S + ..._p ]      at constant a and lambda.

The matrix is that of the accelerations, so that its elimination is shared. This code is two to four times shorter than
the derivatives of solved accelerations, which hold those of the elimination.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from symbody.dynamics import ForwardDynamics
from symbody.symbolic import (
    Expr,
    are_small,
    derivation,
    jacobian,
    ldl_solve,
    saddle_point_solve,
    substitute,
)

from .model import DAMPING, Model

__all__ = ["ImplicitVariation", "implicit_variation", "solution_values", "through_unknowns"]

Rows = list[list[Expr]]
"""The variations of expressions: a row each, with a column for each parameter."""
_SOLVED = ("ldl", "schur_complement", "null_space", "pivoted")
"""The methods that eliminate a matrix once for all right sides."""


@dataclass(frozen=True, eq=False)
class ImplicitVariation:
    """The variations of unknowns that the equations of motion determine.

    Attributes:
        accelerations: da, a row for each speed, a column for each parameter.
        multipliers: dlambda.
    """

    accelerations: Rows
    multipliers: Rows


def implicit_variation(
    model: Model, solution: ForwardDynamics, along: Callable[[Sequence[Expr]], Rows]
) -> ImplicitVariation | None:
    """Return the variations of accelerations and multipliers; None where these can't be had from the equations.

    Truncated equations of small variables are not those that their truncated solution fulfils.

    Args:
        model: the model.
        solution: the accelerations and multipliers.
        along: returns the variations ``e_x S + e_p`` of expressions e.
    """
    eqs = model.equations
    if solution.method not in _SOLVED or are_small([*eqs.derived_residuals, *solution.accelerations]):
        return None
    n, known = len(eqs.speeds), solution_values(model, solution)
    with derivation(fresh=True):
        rows = along(model.with_inputs([*eqs.derived_residuals, *_acceleration_level(model)]))
    with derivation(fresh=True):  # another one, in which no form holds accelerations or multipliers
        at_solution = iter(substitute([entry for row in rows for entry in row], known))
        right = [[-next(at_solution) for _ in row] for row in rows]
        columns = [
            model.with_inputs(_solved(model, solution.method, side[:n], side[n:]))
            for side in map(list, zip(*right, strict=True))
        ]
    found = [list(row) for row in zip(*columns, strict=True)]
    return ImplicitVariation(found[:n], found[n:])


def solution_values(model: Model, solution: ForwardDynamics) -> dict[Expr, Expr]:
    """Return the values of accelerations and multipliers."""
    unknowns = (*model.accelerations, *model.multipliers)
    return dict(zip(unknowns, (*solution.accelerations, *solution.multipliers), strict=True))


def through_unknowns(model: Model, expressions: Sequence[Expr], rows: Rows, found: ImplicitVariation) -> Rows:
    """Return variations of expressions of time, state, accelerations and multipliers.

    Args:
        model: the model.
        expressions: the expressions e.
        rows: their variations at constant accelerations and multipliers.
        found: the variations of these.
    """
    unknowns, moved = [*model.accelerations, *model.multipliers], [*found.accelerations, *found.multipliers]
    slopes = jacobian(list(expressions), unknowns)
    return [
        [
            sum(
                (slope * moved[a][j] for a, slope in enumerate(slopes.row(i)) if not slope.is_zero),
                start=entry,
            )
            for j, entry in enumerate(row)
        ]
        for i, row in enumerate(rows)
    ]


def _acceleration_level(model: Model) -> tuple[Expr, ...]:
    """Return the constraints on the level of accelerations, ``A a + c``, with Baumgarte's terms if there are any."""
    eqs = model.equations
    if not eqs.constraints:
        return ()
    bias = eqs.constraint_bias(*(DAMPING if model.is_stabilized else (0, 0)))
    A = eqs.constraint_jacobian
    return tuple(
        sum((slope * a for slope, a in zip(A.row(i), eqs.accelerations, strict=True)), start=rest)
        for i, rest in enumerate(bias)
    )


def _solved(model: Model, method: str, f: Sequence[Expr], c: Sequence[Expr]) -> tuple[Expr, ...]:
    """Return the accelerations and multipliers with other right sides."""
    eqs = model.equations
    if method == "ldl":
        return tuple(ldl_solve(eqs.mass_matrix, f))
    found = saddle_point_solve(eqs.mass_matrix, eqs.constraint_jacobian, f, c, method)
    return (*found.x, *found.y)
