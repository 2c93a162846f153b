"""Saddle-point systems: a symmetric matrix, bordered by conditions."""

from __future__ import annotations

from collections.abc import Sequence

from symbody.errors import ExpressionError
from symbody.symbolic._core import Expr, number
from symbody.symbolic.derivation import derivation
from symbody.symbolic.gram import dot, gram
from symbody.symbolic.ldl import Elimination
from symbody.symbolic.leaves import ExprLike
from symbody.symbolic.linear_solve import linear_solve
from symbody.symbolic.matrix import Matrix

__all__ = ["check_saddle_point", "saddle_point_solve"]


def saddle_point_solve(
    A: Matrix, B: Matrix, right: Sequence[ExprLike], conditions: Sequence[ExprLike]
) -> tuple[tuple[Expr, ...], tuple[Expr, ...]]:
    """Return x and y with ``A x = f + B^T y, B x = c``, by a Schur complement [Benzi, Golub & Liesen 2005, ch. 5].

    ``A = L^T D L`` is eliminated in symbols, where all zeros are known; ``S y = c - B A^-1 f`` with ``S = B A^-1 B^T``
    is solved at run time, by pivoting. Much shorter than pivoting in the whole system; but A has to be positive
    definite as numbers, not only as expressions.

    Args:
        A: a symmetric matrix, n x n.
        B: the gradients of m conditions, m x n.
        right: f, n entries.
        conditions: c, m entries.

    Raises:
        ExpressionError: A isn't symmetric, has a pivot that is identically zero, or the sizes differ.

    >>> from symbody.symbolic import Matrix, symbols
    >>> m, g = symbols("m g")
    >>> saddle_point_solve(Matrix([[m, 0], [0, m]]), Matrix([[1, 0]]), [m * g, m * g], [0])
    ((0, g), (-g*m,))
    """
    check_saddle_point("saddle_point_solve", A, B, right, conditions)
    with derivation():
        elimination = Elimination(A)
        lines = [elimination.forward(B.row(k)) for k in range(B.rows)]
        scaled = [elimination.scaled(line) for line in lines]
        load = elimination.forward(number(entry, "saddle_point_solve: the right side") for entry in right)
        y = linear_solve(
            gram(lines, scaled),
            [condition - dot(line, load) for condition, line in zip(conditions, scaled, strict=True)],
        )
        sums = [entry + dot(column, y) for entry, column in zip(load, zip(*lines, strict=True), strict=True)]
        return elimination.backward(elimination.scaled(sums)), y


def check_saddle_point(
    where: str, A: Matrix, B: Matrix, right: Sequence[ExprLike], conditions: Sequence[ExprLike]
) -> None:
    """See that the parts of a saddle-point system fit.

    Raises:
        ExpressionError: A isn't symmetric, or the sizes differ.
    """
    if A.shape != (B.columns, B.columns) or len(right) != A.rows or len(conditions) != B.rows or A != A.T:
        raise ExpressionError(
            f"{where}: A is {A.rows}x{A.columns}, B {B.rows}x{B.columns}, the right side has {len(right)} "
            f"entries, and there are {len(conditions)} conditions; expected a symmetric A with a row for each column "
            "of B and each entry of the right side, and as many conditions as B has rows"
        )
