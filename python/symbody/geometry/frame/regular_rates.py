"""Regular rates: the rates of coordinates that solve linear equations, each in its most regular form.

Elimination in another order, or the normal equations ``A^T A q' = A^T v``, give the same rates in other forms, which
divide by zero in other positions (`regular_form.py`).
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import cache

from symbody.symbolic import Expr, derivation, jacobian, number, simplify, solve, without_idle_symbols

from .regular_form import regular_form

__all__ = ["normal_equations", "regular_rates"]


def regular_rates(
    ways: Sequence[Sequence[Expr]], rates: Sequence[Expr], coordinates: Sequence[Expr]
) -> dict[Expr, Expr]:
    """Return the rates that solve equations, in the forms that can be evaluated in the most positions.

    Args:
        ways: equations of the same rates, all with the same solution; those that are tried first come first.
        rates: the unknown rates.
        coordinates: the coordinates of a position.

    Raises:
        ExpressionError: the first equations have no solution, or many.
    """
    first = solve(list(ways[0]), list(rates))

    @cache
    def solution(way: int) -> dict[Expr, Expr]:
        with derivation(fresh=True):
            return solve(list(ways[way]), list(rates))

    def forms(rate: Expr) -> Iterator[Expr]:
        (independent,) = without_idle_symbols([first[rate]])
        yield independent
        yield first[rate]
        yield simplify(first[rate])
        for way in range(1, len(ways)):
            yield solution(way)[rate]
            yield simplify(solution(way)[rate])

    return {rate: regular_form(forms(rate), coordinates) for rate in rates}


def normal_equations(equations: Sequence[Expr], rates: Sequence[Expr]) -> list[Expr]:
    """Return ``A^T (A q' - v)`` of equations ``A q' - v``."""
    slopes = jacobian(equations, rates)
    products = [
        sum((slopes[i, j] * equation for i, equation in enumerate(equations)), start=number(0))
        for j in range(len(rates))
    ]
    return [product for product in products if not product.is_zero]
