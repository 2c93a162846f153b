"""Saddle-point systems by a null-space method: a basis of the directions that the conditions allow."""

from __future__ import annotations

from collections.abc import Sequence

from symbody.symbolic._core import Expr, number
from symbody.symbolic.expression.derivation import derivation
from symbody.symbolic.expression.leaves import ExprLike
from symbody.symbolic.expression.matrix import Matrix
from symbody.symbolic.linear.bordered import SaddlePointSolution, check_saddle_point
from symbody.symbolic.linear.dependence import Dependence
from symbody.symbolic.linear.gram import gram, scalar_product
from symbody.symbolic.linear.ldl import Elimination

__all__ = ["null_space_solve"]

_LARGEST_GROWTH = 1e4
"""The largest ratio of ``N^T A N`` to ``A`` on the diagonal. Where it is larger, dependent unknowns move much faster
than independent ones, and other unknowns should be independent."""


def null_space_solve(
    A: Matrix, B: Matrix, right: Sequence[ExprLike], conditions: Sequence[ExprLike]
) -> SaddlePointSolution:
    """Return x and y with ``A x = f + B^T y, B x = c``, by a null-space method [Benzi, Golub & Liesen 2005, ch. 6].

    Some unknowns are independent; the others follow from ``B x = c``, block by block: ``x = p + N z`` with ``B N = 0``
    and ``B p = c``. Then ``N^T A N z = N^T (f - A p)``; for a mechanism, these are its equations of motion in
    independent speeds [Wehage & Haug 1982]. No system is left to be solved at run time, so this is the fastest method.
    In some states, such as a crank at its dead centre, other unknowns should be independent; there, one of the
    conditions of the solution is negative.

    A has to be positive definite as numbers. The arguments are those of `saddle_point_solve`.

    Raises:
        ExpressionError: A isn't symmetric, the sizes differ, a condition follows from others, more than three
            equations have to be solved together, or a pivot is identically zero.

    >>> from symbody.symbolic import Matrix, symbols
    >>> m, g, a, b = symbols("m g a b")
    >>> solution = null_space_solve(Matrix([[m, 0], [0, m]]), Matrix([[a, b]]), [0, -m * g], [0])
    >>> solution.x[0] == a * b * g / (a**2 + b**2), solution.x[1] == -(a**2) * g / (a**2 + b**2)
    (True, True)
    >>> solution.conditions[-1] == 1e4 * m - (m + m * a**2 / b**2)
    True
    """
    check_saddle_point(A, B, right, conditions)
    with derivation():
        f, c = ([number(entry, "null_space_solve") for entry in side] for side in (right, conditions))
        dependence = Dependence(B)
        p, N = dependence.completed({}, c), dependence.directions
        images = [_product(A, column) for column in N]
        mass = gram(N, images)
        rest = [force - image for force, image in zip(f, _product(A, p), strict=True)]
        z = Elimination(mass).solve(scalar_product(column, rest) for column in N)
        x = [start + scalar_product(z, line) for start, line in zip(p, _lines(N, B.columns), strict=True)]
        y = dependence.multipliers([image - force for image, force in zip(_product(A, x), f, strict=True)])
        growth = [_LARGEST_GROWTH * A[j, j] - mass[k, k] for k, j in enumerate(dependence.independent)]
        return SaddlePointSolution(tuple(x), y, (*dependence.certainties, *growth))


def _product(A: Matrix, column: Sequence[Expr]) -> list[Expr]:
    return [scalar_product(A.row(i), column) for i in range(A.rows)]


def _lines(N: Sequence[Sequence[Expr]], count: int) -> list[list[Expr]]:
    return [[column[i] for column in N] for i in range(count)]
