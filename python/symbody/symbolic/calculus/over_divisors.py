"""Sums whose terms with one divisor stand over it: ``(b*c - a*d)/u - m*u`` for ``b*c/u - m*u - a*d/u``."""

from __future__ import annotations

from symbody.symbolic import _core
from symbody.symbolic._core import Expr


def over_divisors(expression: Expr) -> Expr:
    """Return a sum with its terms of one divisor over it; another expression as it is.

    >>> from symbody import symbols
    >>> drive, loss, mass, speed = symbols("drive loss mass speed")
    >>> over_divisors(mass * speed + drive / speed + loss / speed)
    mass*speed + (drive + loss)/speed
    """
    if expression.kind != "sum":
        return expression
    groups = dict[Expr, list[Expr]]()
    for term in _terms(expression):
        divisor = _core.product_of([factor for factor in _factors(term) if _is_divisor(factor)])
        groups.setdefault(divisor, []).append(term / divisor)
    if all(len(terms) == 1 for terms in groups.values()):
        return expression
    return _core.sum_of([_core.sum_of(terms) * divisor for divisor, terms in groups.items()])


def _terms(expression: Expr) -> list[Expr]:
    return (
        [term for arg in expression.args for term in _terms(arg)]
        if expression.kind == "sum"
        else [expression]
    )


def _factors(term: Expr) -> list[Expr]:
    return [factor for arg in term.args for factor in _factors(arg)] if term.kind == "product" else [term]


def _is_divisor(factor: Expr) -> bool:
    return factor.kind == "power" and factor.args[1].is_number and factor.args[1].ratio[0] < 0
