"""Differences of parameters, such as ``R - r``, that stay together where a value depends on nothing else of them."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from symbody.symbolic import _core
from symbody.symbolic._core import Expr

from .derivative import diff, substitute


def by_differences(expression: Expr, known: Iterable[Expr]) -> tuple[Expr, dict[Expr, Expr]]:
    """Return an expression with symbols for the differences through which alone it depends on their parameters.

    Returns:
        The expression, and the differences by the symbols that stand for them.
    """
    used = dict[Expr, Expr]()
    for number, difference in enumerate(known):
        first, *others = sorted(difference.free_symbols, key=str)
        if not {first, *others} <= expression.free_symbols:
            continue
        standing = _core.symbol(f"difference_{number}")
        solved = first + (standing - difference) / diff(difference, first)
        (found,) = substitute([expression], {first: solved})
        if all(diff(found, other).is_zero for other in others):
            expression, used[standing] = found, difference
    return expression, used


def with_differences(form: Expr, used: Mapping[Expr, Expr]) -> Expr:
    """Return a form with the differences in the places of their symbols."""
    (found,) = substitute([form], used)
    return found
