"""Dependent unknowns: underdetermined linear equations, solved block by block without a system left for run time."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import reduce
from itertools import combinations, permutations
from operator import mul

from symbody.symbolic._core import Expr, number
from symbody.symbolic.expression.functions import Abs
from symbody.symbolic.expression.matrix import Matrix
from symbody.symbolic.linear.block_triangular import Block, block_triangular
from symbody.symbolic.linear.gram import scalar_product

__all__ = ["Dependence"]

_LEAST_DETERMINANT = 1e-3
"""The smallest ratio of a determinant to the sum of its terms' moduli, so that cancellation does no harm."""


class Dependence:
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
