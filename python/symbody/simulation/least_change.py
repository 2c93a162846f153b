"""The least changes of a state that lead onto the constraints."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TypeAlias

from symbody.dynamics import Equations
from symbody.symbolic import (
    Expr,
    Matrix,
    derivation,
    linear_solve,
    null_space_solve,
    number,
    saddle_point_solve,
    substitute,
)

__all__ = ["LeastChange", "least_change"]


@dataclass(frozen=True)
class LeastChange:
    """What is added to a state.

    Attributes:
        coordinates: to its coordinates.
        speeds: to its speeds.
        conditions: what has to be positive, as numbers, for these to be accurate.
    """

    coordinates: tuple[Expr, ...]
    speeds: tuple[Expr, ...]
    conditions: tuple[Expr, ...]


def least_change(eqs: Equations, method: str) -> LeastChange:
    """Return the least changes of coordinates and of speeds that lead onto the constraints, to first order.

    ``M d = phi_q^T mu, phi_q d = -phi`` [Eich 1993]: least in kinetic energy, so that lengths and angles weigh what
    they should. The coordinates follow by the kinematics.

    Args:
        eqs: the equations of motion.
        method: how the system is solved, as `forward_dynamics` has it: "schur_complement", "null_space", "pivoted".
    """
    solve = _METHODS[method]
    with derivation(fresh=True):
        M, J = eqs.mass_matrix, eqs.constraint_jacobian
        change, conditions = solve(M, J, [-value for value in eqs.constraints])
        speeds, _ = solve(M, J, [-value for value in eqs.system.rate(eqs.constraints)])
        return LeastChange(_moved(eqs, change), speeds, conditions)


def _moved(eqs: Equations, change: Sequence[Expr]) -> tuple[Expr, ...]:
    """Return what speeds make of the coordinates in a unit of time, beyond what happens at rest."""
    kinematics = tuple(eqs.kinematics.values())
    at_rest = substitute(kinematics, dict.fromkeys(eqs.speeds, number(0)))
    moved = substitute(kinematics, dict(zip(eqs.speeds, change, strict=True)))
    return tuple(rate - rest for rate, rest in zip(moved, at_rest, strict=True))


_Solution: TypeAlias = tuple[tuple[Expr, ...], tuple[Expr, ...]]


def _schur_complement(M: Matrix, J: Matrix, right: Sequence[Expr]) -> _Solution:
    return saddle_point_solve(M, J, [number(0)] * M.rows, right)[0], ()


def _null_space(M: Matrix, J: Matrix, right: Sequence[Expr]) -> _Solution:
    solution = null_space_solve(M, J, [number(0)] * M.rows, right)
    return solution.x, solution.conditions


def _pivoted(M: Matrix, J: Matrix, right: Sequence[Expr]) -> _Solution:
    n, m, nothing = M.rows, J.rows, number(0)
    upper = [[*M.row(i), *(-J[k, i] for k in range(m))] for i in range(n)]
    whole = Matrix([*upper, *([*J.row(k), *[nothing] * m] for k in range(m))])
    return linear_solve(whole, [*[nothing] * n, *right])[:n], ()


_METHODS: dict[str, Callable[[Matrix, Matrix, Sequence[Expr]], _Solution]] = {
    "schur_complement": _schur_complement,
    "null_space": _null_space,
    "pivoted": _pivoted,
}
