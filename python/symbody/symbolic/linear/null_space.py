"""Saddle-point systems by a null-space method: a basis of the directions that the conditions allow."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import reduce
from itertools import combinations, permutations
from operator import mul

from symbody.symbolic._core import Expr, number
from symbody.symbolic.expression.derivation import derivation
from symbody.symbolic.expression.functions import Abs
from symbody.symbolic.expression.leaves import ExprLike
from symbody.symbolic.expression.matrix import Matrix
from symbody.symbolic.linear.block_triangular import Block, block_triangular
from symbody.symbolic.linear.bordered import SaddlePointSolution, check_saddle_point
from symbody.symbolic.linear.gram import gram, scalar_product
from symbody.symbolic.linear.ldl import Elimination

__all__ = ["null_space_solve"]

_LEAST_DETERMINANT = 1e-3
"""The smallest ratio of a determinant to the sum of its terms' moduli, so that cancellation does no harm."""

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
        dependence = _Dependence(B)
        p, N = dependence.completed({}, c), dependence.directions
        images = [_product(A, column) for column in N]
        mass = gram(N, images)
        rest = [force - image for force, image in zip(f, _product(A, p), strict=True)]
        z = Elimination(mass).solve(scalar_product(column, rest) for column in N)
        x = [start + scalar_product(z, line) for start, line in zip(p, _lines(N, B.columns), strict=True)]
        y = dependence.multipliers([image - force for image, force in zip(_product(A, x), f, strict=True)])
        growth = [_LARGEST_GROWTH * A[j, j] - mass[k, k] for k, j in enumerate(dependence.independent)]
        return SaddlePointSolution(tuple(x), y, (*dependence.certainties, *growth))


class _Dependence:
    """The equations ``B x = c``, solved for the dependent unknowns."""

    def __init__(self, B: Matrix) -> None:
        order = block_triangular(B)
        self.B, self.blocks, self.independent = B, order.blocks, order.independent
        squares = [_square(B, block) for block in self.blocks]
        self.adjugates = [_adjugate(square) for square in squares]
        self.reciprocals = [
            1 / scalar_product(square.row(0), [line[0] for line in adjugate])
            for square, adjugate in zip(squares, self.adjugates, strict=True)
        ]
        self.certainties = [_certainty(square) for square in squares]

    @property
    def directions(self) -> list[list[Expr]]:
        """The columns of N: the solution of ``B x = 0`` in which one independent unknown is 1, the others 0."""
        nothing = [number(0)] * self.B.rows
        return [self.completed({column: number(1)}, nothing) for column in self.independent]

    def completed(self, given: Mapping[int, Expr], right: Sequence[Expr]) -> list[Expr]:
        """Return the solution for given independent unknowns; those not given are zero."""
        x = [given.get(column, number(0)) for column in range(self.B.columns)]
        for block, adjugate, reciprocal in zip(self.blocks, self.adjugates, self.reciprocals, strict=True):
            rest = [right[row] - scalar_product(self.B.row(row), x) for row in block.rows]
            for column, line in zip(block.columns, adjugate, strict=True):
                x[column] = reciprocal * scalar_product(line, rest)
        return x

    def multipliers(self, load: Sequence[Expr]) -> tuple[Expr, ...]:
        """Return y with ``B^T y = load``, from the rows of the dependent unknowns."""
        y, gradients = [number(0)] * self.B.rows, self.B.T
        steps = zip(self.blocks, self.adjugates, self.reciprocals, strict=True)
        for block, adjugate, reciprocal in reversed(list(steps)):
            rest = [load[column] - scalar_product(gradients.row(column), y) for column in block.columns]
            for row, line in zip(block.rows, zip(*adjugate, strict=True), strict=True):
                y[row] = reciprocal * scalar_product(line, rest)
        return tuple(y)


def _square(B: Matrix, block: Block) -> Matrix:
    return Matrix([[B[row, column] for column in block.columns] for row in block.rows])


def _adjugate(square: Matrix) -> list[list[Expr]]:
    """Return the rows of the inverse times the determinant."""
    places = range(square.rows)
    return [[(-1) ** (i + j) * _minor(square, i, j) for i in places] for j in places]


def _minor(square: Matrix, i: int, j: int) -> Expr:
    """Return the determinant without one row and one column."""
    rows, columns = ([k for k in range(square.rows) if k != left_out] for left_out in (i, j))
    return sum(_terms(square, rows, columns), start=number(0)) if rows else number(1)


def _terms(square: Matrix, rows: Sequence[int], columns: Sequence[int]) -> list[Expr]:
    """Return the signed products of a determinant that aren't identically zero [Leibniz]."""
    terms = []
    for order in permutations(range(len(rows))):
        inversions = sum(a > b for a, b in combinations(order, 2))
        factors = (square[row, columns[place]] for row, place in zip(rows, order, strict=True))
        terms.append(reduce(mul, factors, number((-1) ** inversions)))
    return [term for term in terms if not term.is_zero]


def _certainty(square: Matrix) -> Expr:
    """Return an expression that is positive where the determinant is well above the rounding errors of its terms."""
    places = range(square.rows)
    terms = _terms(square, places, places)
    size = sum((Abs(term) for term in terms), start=number(0))
    return Abs(sum(terms, start=number(0))) - _LEAST_DETERMINANT * size


def _product(A: Matrix, column: Sequence[Expr]) -> list[Expr]:
    return [scalar_product(A.row(i), column) for i in range(A.rows)]


def _lines(N: Sequence[Sequence[Expr]], count: int) -> list[list[Expr]]:
    return [[column[i] for column in N] for i in range(count)]
