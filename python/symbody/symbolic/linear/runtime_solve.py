"""Linear systems that are solved at run time: values without a formula, with a known derivative."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from symbody.errors import ArgumentError, ExpressionError
from symbody.symbolic import _core
from symbody.symbolic._core import Expr
from symbody.symbolic.expression.leaves import ExprLike
from symbody.symbolic.expression.matrix import Matrix
from symbody.symbolic.given.arguments import counted, described

__all__ = ["linear_solve"]


def linear_solve(
    matrix: Matrix | Sequence[Sequence[ExprLike]], right: Matrix | Sequence[ExprLike]
) -> tuple[Expr, ...]:
    """Return the solution x of ``A x = b`` as values that are computed at run time, by elimination with pivoting.

    Pivots are chosen among the numbers, so no symbolic pivot can vanish. Where A is singular, x is the
    minimum-norm solution (the least-squares solution if there is none), and a notice says which equations follow from
    others or contradict them. The derivative is ``dx = A^-1 (db - dA x)``, which holds where the rank of A is constant.
    Solutions with the same matrix share its factorization.

    Args:
        matrix: A, n x n.
        right: b, n entries, or a matrix of one column.

    Raises:
        ExpressionError: the matrix is not square, or its number of rows differs from that of b.
        ArgumentError: b is not a list of expressions.

    >>> from symbody import Matrix, linear_solve, symbols
    >>> a, b, c = symbols("a b c")
    >>> x, y = linear_solve(Matrix([[a, b], [b, -a]]), [c, 0])
    >>> a * x + b * y == c
    True
    >>> x == a * c / (a**2 + b**2)
    True
    """
    square = matrix if isinstance(matrix, Matrix) else Matrix(matrix)
    if isinstance(right, Matrix) and right.columns != 1:
        raise ExpressionError(
            f"linear_solve: the right side is {right.rows}x{right.columns}; expected one column"
        )
    if not isinstance(right, Matrix | Iterable):
        raise ArgumentError(
            f"linear_solve, right side: {described(right)}; expected as many entries as A has rows"
        )
    entries = list(right.entries if isinstance(right, Matrix) else right)
    if square.rows != square.columns or square.rows != len(entries):
        raise ExpressionError(
            f"linear_solve: the matrix is {square.rows}x{square.columns} and the right side has "
            f"{counted(len(entries), 'entry')}; expected a square matrix and as many entries as it has rows"
        )
    return _core.linear_solve(square.entries, entries)
