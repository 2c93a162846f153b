"""Sums whose terms with one divisor stand over it: ``(b*c - a*d)/u - m*u`` for ``b*c/u - m*u - a*d/u``."""

from __future__ import annotations

from symbody.symbolic import _core
from symbody.symbolic._core import Expr

from .quotient import factors, powers
from .summands import summands


def over_divisors(expression: Expr) -> Expr:
    """Return a sum with its terms of one divisor over it; another expression as it is.

    >>> from symbody import symbols
    >>> drive, loss, mass, speed = symbols("drive loss mass speed")
    >>> over_divisors(drive / speed - mass * speed - loss / speed)
    (drive - loss)/speed - mass*speed
    """
    groups, found = dict[Expr, list[Expr]](), summands(expression)
    for term in found:
        divisor = powers({base: exponent for base, exponent in factors(term) if exponent < 0})
        groups.setdefault(divisor, []).append(term / divisor)
    if len(groups) == len(found):
        return expression
    return _core.sum_of([_core.sum_of(tops) * divisor for divisor, tops in groups.items()])
