"""Expressions with rounded decimals: each coefficient agrees to the digits that are printed, also that of a small term.

Sums of products of powers of names are compared term by term. Others agree at random points, with their derivatives.
"""

from __future__ import annotations

import random
from collections.abc import Mapping
from fractions import Fraction
from itertools import islice

from symbody.errors import SymbodyError
from symbody.symbolic import Expr, diff, expand, free_symbols, number, subs, symbol
from symbody.symbolic.expression.traverse import post_order

__all__ = ["nearly_equal"]

#: Decimals are printed with some 10 digits, fewer if ``Digits`` says so.
_TOLERANCE = 1e-6

#: What is left of 1 - 1 by 10 digits.
_NOISE = 1e-9

#: How many nodes an expression has at most that is compared term by term.
_LARGE = 1000

_POINTS = 3

_GENERATORS = frozenset({"symbol", "application", "time_function"})
_FAULTS = (SymbodyError, TypeError, ValueError, OverflowError, ZeroDivisionError)


def nearly_equal(file: Expr, run: Expr) -> bool:
    """Return whether two expressions with rounded decimals have one value."""
    try:
        floor = _NOISE if 0 in {file, run} else 0.0
        is_small = len(list(islice(_nodes(file, run), _LARGE))) < _LARGE
        by_terms = _by_terms(file, run, floor) if is_small else None
        return _by_values(file, run, floor) if by_terms is None else by_terms
    except _FAULTS:
        return False


def _nodes(file: Expr, run: Expr) -> list[Expr]:
    return list(post_order([file, run], lambda node: node.args, lambda node: node.id))


def _by_terms(file: Expr, run: Expr, floor: float) -> bool | None:
    """Return whether all coefficients agree; None where terms of other forms may have the same value."""
    left, right = _coefficients(file), _coefficients(run)
    pairs = [(left.get(term, 0.0), right.get(term, 0.0)) for term in {**left, **right}]
    if _agree(pairs, floor):
        return True
    is_unique = all(_is_monomial(term) for term in {**left, **right})
    return False if is_unique else None


def _agree(pairs: list[tuple[float, float]], floor: float) -> bool:
    """Whether numbers agree in pairs, but for what rounding leaves of zero, beside the largest of them."""
    noise = max(floor, _NOISE * min(1.0, max((abs(each) for pair in pairs for each in pair), default=1.0)))
    return all(abs(a - b) <= max(_TOLERANCE * max(abs(a), abs(b)), noise) for a, b in pairs)


def _coefficients(expression: Expr) -> Mapping[Expr, float]:
    """Return the coefficient of each product of what isn't a number, in an expanded expression."""
    whole = expand(expression)
    found: dict[Expr, float] = {}
    for term in whole.args if whole.kind == "sum" else (whole,):
        coefficient, rest = 1.0, number(1)
        for factor in _factors(term):
            if _is_constant(factor):
                coefficient *= float(factor)
            else:
                rest = rest * factor
        found[rest] = found.get(rest, 0.0) + coefficient
    return found


def _factors(term: Expr) -> list[Expr]:
    if term.kind != "product":
        return [term]
    return [factor for part in term.args for factor in _factors(part)]


def _is_constant(factor: Expr) -> bool:
    return not any(node.kind in _GENERATORS for node in _nodes(factor, factor))


def _is_monomial(term: Expr) -> bool:
    """Whether a term is a product of whole powers of names, which no other form has the value of."""
    return all(
        factor.kind in {*_GENERATORS, "number"}
        or (factor.kind == "power" and factor.args[0].kind in _GENERATORS and _is_whole(factor.args[1]))
        for factor in _factors(term)
    )


def _is_whole(exponent: Expr) -> bool:
    return exponent.kind == "number" and float(exponent).is_integer()


def _by_values(file: Expr, run: Expr, floor: float) -> bool:
    """Return whether two expressions agree at random points, and their derivatives at the first of them."""
    applications = (node for node in _nodes(file, run) if node.kind == "application")
    names = sorted({*free_symbols([file, run]), *applications}, key=str)
    variables = {name: symbol(f"_variable{index}") for index, name in enumerate(names)}
    left, right = subs(file, variables), subs(run, variables)
    chance = random.Random(7)
    points = [
        {variable: number(Fraction(chance.randint(100, 999), 500)) for variable in variables.values()}
        for _ in range(_POINTS)
    ]
    slopes = [_at(diff(left, each), diff(right, each), points[0]) for each in variables.values()]
    return _agree(slopes, floor) and all(_agree([_at(left, right, point)], floor) for point in points)


def _at(file: Expr, run: Expr, point: Mapping[Expr, Expr]) -> tuple[float, float]:
    return float(subs(file, point)), float(subs(run, point))
