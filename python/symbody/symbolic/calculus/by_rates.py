"""Expressions as books write equations of motion: accelerations, then products of speeds, then the rest."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction
from itertools import combinations_with_replacement

from symbody.errors import SymbodyError
from symbody.symbolic import _core
from symbody.symbolic._core import Expr

from .derivative import diff, substitute

Product = tuple[Expr, Expr]
"""A coefficient, and what it multiplies."""


def by_rates(expression: Expr, form: Callable[[Expr], Expr]) -> Expr | None:
    """Return ``M q'' + h(q, q') + g(q)`` with one coefficient for each acceleration and each product of speeds.

    None for what is not linear in the accelerations or holds neither these nor speeds.

    Args:
        expression: the expression.
        form: which finds the form of a coefficient.

    >>> from symbody import cos, functions_of_time, symbols, t
    >>> q, (a, b) = functions_of_time("q"), symbols("a b")
    >>> by_rates(a * (q.diff(t, 2) + cos(q) * (b * q.diff(t, 2) + a * q.diff(t) ** 2)), lambda each: each)
    a*(b*cos(q) + 1)*q'' + a**2*cos(q)*q'**2
    """
    accelerations, speeds = (_rates(expression, order) for order in (2, 1))
    if not accelerations and not speeds:
        return None
    products = [(diff(expression, rate), rate) for rate in accelerations]
    rest = _without(expression, accelerations)
    if rest is None or any(set(accelerations) & factor.free_symbols for factor, _ in products):
        return None
    of_speeds = _by_speeds(rest, speeds)
    if of_speeds is None:
        products, constant = [*products, (rest, _core.number(1))], _core.number(0)
    else:
        products, constant = [*products, *of_speeds[0]], of_speeds[1]
    terms = [form(factor) * rates for factor, rates in _joined(products)]
    found = _core.sum_of([*terms, form(constant)])
    return found if found == expression else None


def _rates(expression: Expr, order: int) -> tuple[Expr, ...]:
    leaves = (
        leaf for leaf in expression.free_symbols if leaf.kind == "time_function" and leaf.order == order
    )
    return tuple(sorted(leaves, key=str))


def _without(expression: Expr, rates: Sequence[Expr]) -> Expr | None:
    try:
        return substitute([expression], dict.fromkeys(rates, _core.number(0)))[0]
    except SymbodyError:  # undefined at rest
        return None


def _by_speeds(expression: Expr, speeds: Sequence[Expr]) -> tuple[list[Product], Expr] | None:
    """Return the products of speeds and the rest of what is quadratic in the speeds, and None of others."""
    slopes = [diff(expression, speed) for speed in speeds]
    constant, *linear = (_without(each, speeds) for each in (expression, *slopes))
    if constant is None or None in linear:
        return None
    products = [(a, b) for a, b in zip(linear, speeds, strict=True) if a is not None and not a.is_zero]
    for (i, first), (j, second) in combinations_with_replacement(enumerate(speeds), 2):
        slope = _without(diff(slopes[i], second), speeds)
        if slope is None:
            return None
        if not slope.is_zero:
            products.append((slope if i != j else slope / 2, first * second))
    total = _core.sum_of([constant, *(factor * rates for factor, rates in products)])
    return (products, constant) if total == expression else None


def _joined(products: Sequence[Product]) -> list[Product]:
    """Return products with one term for all whose coefficients are proportional by a small number.

    The smallest of these coefficients stands in the term, so that ``2*x'*y' + y'**2`` has no fractions.
    """
    found = dict[Expr, list[Expr]]()
    for factor, rates in products:
        ratio = next((ratio for ratio in _RATIOS if factor / ratio in found), None)
        if ratio is None:
            found[factor] = [rates]
        elif ratio.ratio[1] == 1:
            found[factor / ratio].append(ratio * rates)
        else:
            larger = factor / ratio
            terms = [*(each / ratio for each in found.pop(larger)), rates]
            found[factor] = terms
    return [(factor, _core.sum_of(terms)) for factor, terms in found.items()]


_RATIOS = tuple(_core.number(ratio) for ratio in (1, -1, Fraction(1, 2), Fraction(-1, 2), 2, -2))
