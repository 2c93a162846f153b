"""How often a polynomial has a root: ``solve`` repeats it, as Maple does."""

from __future__ import annotations

from collections.abc import Sequence

from symbody.errors import SymbodyError
from symbody.symbolic import Expr, number
from symbody.worksheet.mathematics.polynomial import coefficients

__all__ = ["repeated"]

_HIGHEST = 8
"""The highest degree of a polynomial whose roots are counted."""


def repeated(polynomial: Expr, variable: Expr, roots: Sequence[Expr]) -> list[Expr]:
    """Return roots, each one as often as the polynomial has it; of what is no polynomial, as they are."""
    try:
        degree = max(coefficients(polynomial, variable), default=0)
    except SymbodyError:
        return list(roots)
    if not len(roots) < degree <= _HIGHEST or len(set(roots)) < len(roots):
        return list(roots)
    return [root for root in roots for _ in range(_multiplicity(polynomial, variable, root, degree))]


def _multiplicity(polynomial: Expr, variable: Expr, root: Expr, degree: int) -> int:
    """Return how many derivatives of a polynomial, itself among them, are zero at a root."""
    count, slope = 0, polynomial
    while count < degree and slope.subs({variable: root}) == number(0):
        count, slope = count + 1, slope.diff(variable)
    return max(count, 1)
