"""One component of the solution of a linear system, written as a function of the system's entries."""

from __future__ import annotations

from math import isqrt

from symbody.errors import ExpressionError
from symbody.symbolic import _core
from symbody.symbolic._core import Expr
from symbody.symbolic.given.arguments import counted

__all__ = ["linear_solution"]


def linear_solution(index: Expr, *entries: Expr) -> Expr:
    """Return component ``index`` of the solution, given the matrix row by row and then the right side.

    Components are printed in this form, so it is what the parser and unpickling read.
    """
    n = (isqrt(4 * len(entries) + 1) - 1) // 2
    if n * n + n != len(entries) or not index.is_number or index not in range(n):
        raise ExpressionError(
            f"linear_solution({index}, ...) with {counted(len(entries), 'entry')}: expected a component's number "
            "from 0, then the n*n entries of a matrix and the n entries of a right side"
        )
    return _core.linear_solve(entries[: n * n], entries[n * n :])[int(index.ratio[0])]
