"""Quotients: the numerator and the denominator of an expression, each a product of powers."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping
from typing import NamedTuple

from symbody.symbolic._core import Expr, number

_ONE = number(1)


class Quotient(NamedTuple):
    """A numerator over a product of natural powers.

    Attributes:
        top: the numerator.
        bottom: the exponents of the factors below, each at least 1.
    """

    top: Expr
    bottom: Mapping[Expr, int]


def quotient(e: Expr) -> Quotient:
    """Return an expression as one quotient; quotients inside functions stay.

    >>> from symbody import symbols
    >>> a, b, c = symbols("a b c")
    >>> quotient(a / (1 + c / a))
    Quotient(top=a**2, bottom={a + c: 1})
    """
    if e.kind == "sum":
        parts = [quotient(term) for term in e.args]
        below = Counter[Expr]()
        for part in parts:
            below |= Counter(part.bottom)
        total = number(0)
        for part in parts:
            total += part.top * powers({base: n - part.bottom.get(base, 0) for base, n in below.items()})
        return Quotient(total, dict(below))
    exponents = Counter[Expr]()
    for factor, exponent in factors(e):
        inner = quotient(factor) if factor.kind == "sum" else Quotient(factor, {})
        for base, n in (*factors(inner.top), *((base, -n) for base, n in inner.bottom.items())):
            exponents[base] += n * exponent
    top = powers({base: n for base, n in exponents.items() if n > 0})
    return Quotient(top, {base: -n for base, n in exponents.items() if n < 0})


def powers(exponents: Mapping[Expr, int]) -> Expr:
    """Return the product of powers."""
    found = _ONE
    for base, exponent in exponents.items():
        found *= base**exponent
    return found


def factors(e: Expr, exponent: int = 1) -> Iterator[tuple[Expr, int]]:
    """Yield the factors of nested products and whole powers, with their exponents."""
    if e.kind == "product":
        for factor in e.args:
            yield from factors(factor, exponent)
    elif (
        e.kind == "power"
        and e.args[1].is_number
        and e.args[1].ratio[1] == 1
        and abs(e.args[1].ratio[0]) < _MOST
    ):
        yield from factors(e.args[0], exponent * e.args[1].ratio[0])
    elif e != _ONE:
        yield e, exponent


_MOST = 10
"""Exponents from which on a power is one factor."""
