"""Saddle-point systems: a symmetric matrix, bordered by conditions; one row for each method."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from symbody.errors import ExpressionError
from symbody.symbolic.expression.leaves import ExprLike
from symbody.symbolic.expression.matrix import Matrix
from symbody.symbolic.linear.bordered import SaddlePointSolution, bordered_solve
from symbody.symbolic.linear.null_space import null_space_solve
from symbody.symbolic.linear.schur_complement import schur_complement_solve

__all__ = ["saddle_point_solve"]

_METHODS: dict[
    str, Callable[[Matrix, Matrix, Sequence[ExprLike], Sequence[ExprLike]], SaddlePointSolution]
] = {
    "schur_complement": schur_complement_solve,
    "null_space": null_space_solve,
    "pivoted": bordered_solve,
}


def saddle_point_solve(
    A: Matrix,
    B: Matrix,
    right: Sequence[ExprLike],
    conditions: Sequence[ExprLike],
    method: str = "schur_complement",
) -> SaddlePointSolution:
    """Return x and y with ``A x = f + B^T y, B x = c`` [Benzi, Golub & Liesen 2005].

    Args:
        A: a symmetric matrix, n x n.
        B: the gradients of m conditions, m x n.
        right: f, n entries.
        conditions: c, m entries.
        method: "schur_complement" solves a small system at run time. "null_space" solves nothing at run time, but is
            accurate only where its conditions are positive. Both need an A that is positive definite numerically.
            "pivoted" solves the whole system at run time.

    Raises:
        ExpressionError: the method is unknown; A is not symmetric or has a pivot that is identically zero; the sizes
            differ; or the null space has no small blocks.

    >>> from symbody.symbolic import Matrix, symbols
    >>> m, g = symbols("m g")
    >>> solution = saddle_point_solve(Matrix([[m, 0], [0, m]]), Matrix([[1, 0]]), [m * g, m * g], [0])
    >>> solution.x, solution.y
    ((0, g), (-g*m,))
    """
    if method not in _METHODS:
        raise ExpressionError(
            f"saddle_point_solve: the method {method!r}; expected one of {', '.join(_METHODS)}"
        )
    return _METHODS[method](A, B, right, conditions)
