"""Fractions before brackets: ``(5*m + 4*M)/4`` for ``5*m/4 + M``."""

from __future__ import annotations

from fractions import Fraction
from math import lcm

from symbody.symbolic import _core
from symbody.symbolic._core import Expr

from .reading import parts_of


def with_fractions_outside(form: Expr) -> Expr:
    """Return a product in whose sums no term has a fraction: one fraction stands before all of it.

    >>> from symbody import symbols
    >>> m, M, l = symbols("m M l")
    >>> with_fractions_outside(l**2 * (5 * m / 4 + M))
    (4*M + 5*m)*l**2/4
    """
    factors = parts_of(form, "product")
    made, outside = list[Expr](), 1
    for factor in factors:
        terms = parts_of(factor, "sum")
        common = lcm(*map(_denominator, terms)) if len(terms) > 1 else 1
        made.append(_core.sum_of([common * term for term in terms]) if common > 1 else factor)
        outside *= common
    return form if outside == 1 else _core.number(Fraction(1, outside)) * _core.product_of(made)


def _denominator(term: Expr) -> int:
    numbers = (part for part in parts_of(term, "product") if part.is_number and not part.is_decimal)
    return lcm(*(part.ratio[1] for part in numbers))
