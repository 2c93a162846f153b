"""A rational function over its common denominator: a/m + b is (a + b*m)/m."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass

from symbody.symbolic import Expr, number
from symbody.symbolic.expression.traverse import post_order

__all__ = ["common_fraction"]


@dataclass(frozen=True, slots=True)
class _Fraction:
    """A fraction: its denominator is a whole number and powers of other bases."""

    above: Expr
    below: int
    bases: Counter[Expr]


def common_fraction(value: Expr) -> tuple[Expr, Expr]:
    """Return the numerator and the denominator of a rational function, without a common factor that is seen.

    Sums come over the least common multiple of the denominators of their terms, by their factors as they are written.
    """
    found: dict[int, _Fraction] = {}
    for node in post_order([value], _inner, lambda node: node.id):
        found[node.id] = _fraction(node, [found[each.id] for each in _inner(node)])
    return found[value.id].above, _denominator(found[value.id])


def _inner(node: Expr) -> Iterable[Expr]:
    if node.kind == "power":
        return node.args[:1] if _is_whole(node.args[1]) else ()
    return node.args if node.kind in ("sum", "product") else ()


def _is_whole(exponent: Expr) -> bool:
    return exponent.is_number and exponent.ratio[1] == 1


def _fraction(node: Expr, parts: list[_Fraction]) -> _Fraction:
    if node.kind == "number" and not node.is_decimal:
        above, below = node.ratio
        return _Fraction(number(above), below, Counter())
    if node.kind == "sum":
        return _sum(parts)
    if node.kind == "product":
        return _product(parts)
    if node.kind == "power" and parts:
        return _power(parts[0], node.args[1].ratio[0])
    return _cancelled(node, 1, Counter())


def _sum(parts: list[_Fraction]) -> _Fraction:
    below = math.lcm(*(each.below for each in parts))
    bases: Counter[Expr] = Counter()
    for each in parts:
        bases |= each.bases
    total = number(0)
    for each in parts:
        total = total + each.above * (below // each.below) * _powers(bases - each.bases)
    return _Fraction(total, below, bases)


def _product(parts: list[_Fraction]) -> _Fraction:
    above, below, bases = number(1), 1, Counter[Expr]()
    for each in parts:
        above, below = above * each.above, below * each.below
        bases += each.bases
    return _cancelled(above, below, bases)


def _power(base: _Fraction, exponent: int) -> _Fraction:
    if exponent >= 0:
        bases = Counter({each: count * exponent for each, count in base.bases.items()})
        return _Fraction(base.above**exponent, base.below**exponent, bases)
    return _cancelled(_denominator(base) ** -exponent, 1, Counter({base.above: -exponent}))


def _cancelled(above: Expr, below: int, bases: Counter[Expr]) -> _Fraction:
    """Return a fraction without the powers and the numbers that stand above and below."""
    left, whole, rest = number(1), 1, Counter[Expr]()
    for factor in _factors(above / (number(below) * _powers(bases))):
        exponent = factor.args[1] if factor.kind == "power" else None
        if factor.kind == "number" and not factor.is_decimal:
            left, whole = left * factor.ratio[0], whole * factor.ratio[1]
        elif exponent is not None and exponent.is_number and exponent.ratio[0] < 0:
            base, (count, root) = factor.args[0], exponent.ratio
            rest[base if root == 1 else base ** (number(1) / root)] -= count
        else:
            left = left * factor
    return _Fraction(left, whole, rest)


def _factors(node: Expr) -> Iterable[Expr]:
    """Return the factors of a product, also of those within it."""
    left = [node]
    while left:
        each = left.pop()
        if each.kind == "product":
            left += reversed(each.args)
        else:
            yield each


def _powers(bases: Counter[Expr]) -> Expr:
    total = number(1)
    for each, count in bases.items():
        total = total * each**count
    return total


def _denominator(fraction: _Fraction) -> Expr:
    return number(fraction.below) * _powers(fraction.bases)
