"""Squares of sums: ``(x + l*sin(q))**2`` for ``x**2 + 2*x*l*sin(q) + l**2*sin(q)**2``."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction
from itertools import combinations
from math import isqrt

from symbody.symbolic import _core
from symbody.symbolic._core import Expr

from .reading import nodes_of, parts_of
from .summands import summands

_FEW, _MOST = 3, 12
"""The terms of a sum between which squares are looked for."""


def with_squares(form: Expr) -> Expr:
    """Return a form in which three terms of a sum are the square of a sum where they are one.

    >>> from symbody import sin, symbols
    >>> x, l, q = symbols("x l q")
    >>> with_squares(x**2 + 2 * x * l * sin(q) + l**2 * sin(q) ** 2)
    (x + l*sin(q))**2
    """
    made = dict[int, Expr]()
    for node in nodes_of(form):
        made[node.id] = _rebuilt(node, [made[arg.id] for arg in node.args])
    return made[form.id]


def squared_sums(form: Expr) -> set[Expr]:
    """Return the sums of which a form has squares.

    >>> from symbody import sin, symbols
    >>> x, l, q = symbols("x l q")
    >>> squared_sums(l + (x + l * sin(q)) ** 2)
    {x + l*sin(q)}
    """
    powers = (node.args for node in nodes_of(form) if node.kind == "power")
    return {base for base, exponent in powers if base.kind == "sum" and exponent == _TWO}


_TWO = _core.number(2)


def _rebuilt(node: Expr, args: Sequence[Expr]) -> Expr:
    """Return a node with other arguments, and with squares if it is a sum that has them."""
    if node.kind not in {"sum", "product", "power"}:
        return node
    made = node
    if any(arg.id != given.id for arg, given in zip(args, node.args, strict=True)):
        made = args[0] ** args[1] if node.kind == "power" else _MAKE[node.kind](args)
    terms = summands(made)
    squared = _squared(terms)
    return _core.sum_of(squared) if len(squared) < len(terms) else made


_MAKE = {"sum": _core.sum_of, "product": _core.product_of}


def _squared(terms: list[Expr]) -> list[Expr]:
    """Return the terms of a sum, with squares as long as there are any."""
    while _FEW <= len(terms) <= _MOST and (found := next(_squares(terms), None)):
        square, used = found
        terms = [square, *(term for place, term in enumerate(terms) if place not in used)]
    return terms


def _squares(terms: Sequence[Expr]) -> Iterator[tuple[Expr, set[int]]]:
    """Yield squares of sums, or their opposites, with the places of the terms that they replace."""
    for sign in (1, -1):
        signed = [sign * term for term in terms]
        places = {term: place for place, term in enumerate(signed)}
        roots = [(place, root) for place, term in enumerate(signed) if (root := _root(term)) is not None]
        for (first, a), (second, b) in combinations(roots, 2):
            for other in (b, -b):
                between = _between(a, other, places)
                if between and not between & {first, second}:
                    yield sign * (a + other) ** 2, {first, second, *between}


def _between(a: Expr, b: Expr, places: Mapping[Expr, int]) -> set[int]:
    """Return the places of ``2*a*b``, one term or one for each term of a or b; none if any is missing."""
    ways = ([2 * a * b], [2 * part * b for part in summands(a)], [2 * a * part for part in summands(b)])
    found = next((way for way in ways if all(product in places for product in way)), [])
    return {places[product] for product in found}


def _root(term: Expr) -> Expr | None:
    """Return the root of a product of squares; None of others."""
    factors = [_root_of_factor(factor) for factor in parts_of(term, "product")]
    found = [factor for factor in factors if factor is not None]
    return _core.product_of(found) if len(found) == len(factors) else None


def square_root(square: Fraction) -> Fraction | None:
    """Return the root of the square of a rational number; None of others."""
    if square < 0:
        return None
    root = Fraction(isqrt(square.numerator), isqrt(square.denominator))
    return root if root**2 == square else None


def _root_of_factor(factor: Expr) -> Expr | None:
    if factor.is_number:
        root = None if factor.is_decimal else square_root(Fraction(*factor.ratio))
        return None if root is None else _core.number(root)
    if factor.kind == "power" and factor.args[1].is_number and not factor.args[1].is_decimal:
        top, bottom = factor.args[1].ratio
        return factor.args[0] ** (top // 2) if bottom == 1 and top % 2 == 0 else None
    return None
