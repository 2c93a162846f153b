"""Saddle-point systems by the Schur complement of their matrix."""

from __future__ import annotations

from collections.abc import Sequence

from symbody.symbolic._core import number
from symbody.symbolic.expression.derivation import derivation
from symbody.symbolic.expression.leaves import ExprLike
from symbody.symbolic.expression.matrix import Matrix
from symbody.symbolic.linear.bordered import SaddlePointSolution, check_saddle_point
from symbody.symbolic.linear.gram import gram, scalar_product
from symbody.symbolic.linear.ldl import Elimination
from symbody.symbolic.linear.runtime_solve import linear_solve

__all__ = ["schur_complement_solve"]


def schur_complement_solve(
    A: Matrix, B: Matrix, right: Sequence[ExprLike], conditions: Sequence[ExprLike]
) -> SaddlePointSolution:
    """Return x and y with ``A x = f + B^T y, B x = c``, by a Schur complement [Benzi, Golub & Liesen 2005, ch. 5].

    ``A = L^T D L`` is eliminated in symbols, where all zeros are known; ``S y = c - B A^-1 f`` with ``S = B A^-1 B^T``
    is solved at run time, with pivoting. This is much shorter than pivoting in the whole system, but A has to be
    positive definite numerically, not only symbolically. The arguments are those of `saddle_point_solve`.

    Raises:
        ExpressionError: A isn't symmetric, has a pivot that is identically zero, or the sizes differ.
    """
    check_saddle_point(A, B, right, conditions)
    with derivation():
        elimination = Elimination(A)
        lines = [elimination.forward(B.row(k)) for k in range(B.rows)]
        scaled = [elimination.scaled(line) for line in lines]
        load = elimination.forward(number(entry, "saddle_point_solve: the right side") for entry in right)
        y = linear_solve(
            gram(lines, scaled),
            [
                condition - scalar_product(line, load)
                for condition, line in zip(conditions, scaled, strict=True)
            ],
        )
        sums = [
            entry + scalar_product(column, y)
            for entry, column in zip(load, zip(*lines, strict=True), strict=True)
        ]
        return SaddlePointSolution(elimination.backward(elimination.scaled(sums)), y)
