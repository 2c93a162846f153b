"""Saddle-point systems solved as a whole: the symmetric matrix, bordered by the conditions."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from symbody.errors import ExpressionError
from symbody.symbolic._core import Expr, number
from symbody.symbolic.expression.derivation import derivation
from symbody.symbolic.expression.leaves import ExprLike
from symbody.symbolic.expression.matrix import Matrix
from symbody.symbolic.given.arguments import counted
from symbody.symbolic.linear.runtime_solve import linear_solve

__all__ = ["SaddlePointSolution", "bordered_solve", "check_saddle_point"]


@dataclass(frozen=True)
class SaddlePointSolution:
    """The solution of a saddle-point system.

    Attributes:
        x: the unknowns.
        y: the multipliers of the conditions.
        conditions: where all are positive, x and y are accurate numerically (about four digits are lost at most);
            empty where they are accurate everywhere.
    """

    x: tuple[Expr, ...]
    y: tuple[Expr, ...]
    conditions: tuple[Expr, ...] = ()


def bordered_solve(
    A: Matrix, B: Matrix, right: Sequence[ExprLike], conditions: Sequence[ExprLike]
) -> SaddlePointSolution:
    """Return x and y with ``[[A, -B^T], [B, 0]] (x, y) = (f, c)``, solved at run time as a whole, by pivoting.

    Any A is allowed, and conditions may follow from each other. The arguments are those of `saddle_point_solve`.
    """
    n, m = A.rows, B.rows
    with derivation():
        upper = [[*A.row(i), *(-B[k, i] for k in range(m))] for i in range(n)]
        lower = [[*B.row(k), *[number(0)] * m] for k in range(m)]
        solution = linear_solve(Matrix([*upper, *lower]), [*right, *conditions])
    return SaddlePointSolution(solution[:n], solution[n:])


def check_saddle_point(
    A: Matrix, B: Matrix, right: Sequence[ExprLike], conditions: Sequence[ExprLike]
) -> None:
    """Check that the parts of a saddle-point system fit together.

    Raises:
        ExpressionError: A isn't symmetric, or the sizes differ.
    """
    if A.shape != (B.columns, B.columns) or len(right) != A.rows or len(conditions) != B.rows or A != A.T:
        raise ExpressionError(
            f"saddle_point_solve: A is {A.rows}x{A.columns}, B {B.rows}x{B.columns}, the right side has "
            f"{counted(len(right), 'entry')}, with {counted(len(conditions), 'condition')}; expected a symmetric A "
            "with a row for each column of B and each entry of the right side, and as many conditions as B has rows"
        )
