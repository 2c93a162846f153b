"""Roots of one equation in one unknown that the core's closed forms don't have: complex ones, of any degree, inverses.

A polynomial with numbers is divided by its rational roots first. Of what is left, and of its factors with rational
coefficients, square roots give degree two and cube roots degree three; higher degrees are ``RootOf(p(_Z), index = k)``,
as in Maple, which evalf makes numbers.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from fractions import Fraction
from math import gcd, lcm
from typing import TYPE_CHECKING

from symbody.deferred import Deferred
from symbody.errors import ExpressionError, WorksheetError
from symbody.symbolic import Expr, acos, asin, atan, cos, exp, expand, log, number, sin, tan
from symbody.symbolic.expression.traverse import post_order
from symbody.worksheet.mathematics.common_fraction import common_fraction
from symbody.worksheet.mathematics.cubic import cubic_roots
from symbody.worksheet.mathematics.polynomial import coefficients
from symbody.worksheet.mathematics.rational_factors import factors_in
from symbody.worksheet.values.complex_number import (
    I,
    angle_of,
    beyond_the_reals,
    of_number,
    root_of_negative,
)
from symbody.worksheet.values.naming import symbol
from symbody.worksheet.values.numeric import as_float, as_integer
from symbody.worksheet.values.structure import Tree, tree_of, walk
from symbody.worksheet.values.value import Relation, Unevaluated, Value

if TYPE_CHECKING:
    import numpy as np
else:
    np = Deferred("numpy")

__all__ = ["closed_roots", "is_complex", "numeric_roots", "polynomial_in", "root_number", "roots_of"]

_Z = symbol("_Z")


def closed_roots(residual: Expr, unknown: Expr) -> list[Value] | None:
    """Return the roots of an equation in one unknown; None if there is no form for them."""
    known = polynomial_in(_numerator(residual, unknown), unknown)
    if known is None:
        return _peeled(residual, unknown)
    return roots_of(known) if len(known) > 1 else None


def polynomial_in(residual: Expr, unknown: Expr) -> list[Expr] | None:
    """Return the coefficients of a polynomial, the constant first; None for another expression."""
    if not _is_polynomial(residual, unknown):
        return None
    try:
        found = coefficients(residual, unknown)
    except (WorksheetError, ExpressionError):
        return None
    coefficients_ = _in_order(found)
    return None if any(each.has(unknown) for each in coefficients_) else coefficients_


def _in_order(found: Mapping[int, Expr]) -> list[Expr]:
    return [found.get(k, number(0)) for k in range(max(found, default=0) + 1)]


def _is_polynomial(value: Expr, unknown: Expr) -> bool:
    """Whether nothing else than sums, products and whole positive powers contains the unknown."""
    for node in post_order([value], lambda node: node.args, lambda node: node.id):
        if node == unknown or not node.has(unknown) or node.kind in ("sum", "product"):
            continue
        exponent = node.args[1] if node.kind == "power" else number(-1)
        if not exponent.is_number or exponent.ratio[1] != 1 or exponent.ratio[0] < 0:
            return False
    return True


def _numerator(residual: Expr, unknown: Expr) -> Expr:
    """Return what is zero where a rational function of the unknown is."""
    return residual if _is_polynomial(residual, unknown) else expand(common_fraction(residual)[0])


def roots_of(known: Sequence[Expr]) -> list[Value]:
    """Return the roots of a polynomial by its coefficients, the constant first."""
    if all(each.is_number for each in known):
        if any(each.is_decimal for each in known):
            return [of_number(each) for each in numeric_roots(known)]
        return _of_fractions([Fraction(*each.ratio) for each in known])
    zeros: list[Value] = []
    rest = list(known)
    while rest[0].is_zero:
        rest.pop(0)
        zeros = [number(0)]
    return [*zeros, *_of_symbols(rest)]


def _of_symbols(known: list[Expr]) -> list[Value]:
    degree = len(known) - 1
    if degree == 1:
        return [-known[0] / known[1]]
    if degree == 3:
        return [*cubic_roots(known)]
    if degree > 1:
        terms = [c * _Z**k for k, c in enumerate(known)]
        return [Unevaluated(symbol("RootOf"), (sum(terms, start=number(0)),))]
    return []


def _of_fractions(known: list[Fraction]) -> list[Value]:
    found: list[Value] = []
    while len(known) > 1 and (root := _rational_root(known)) is not None:
        found.append(number(root.numerator) / root.denominator)
        known = _divided(known, root)
    degree = len(known) - 1
    if degree < 1:
        return found
    if degree == 2:
        return [*found, *_quadratic(*known)]
    if degree == 3:
        return [*found, *cubic_roots([number(c.numerator) / c.denominator for c in known])]
    if degree == 4 and not known[1] and not known[3]:
        squares = _quadratic(known[0], known[2], known[4])
        if all(as_float(each) is not None for each in squares):
            return [*found, *(sign * _root(each) for each in squares for sign in (1, -1))]
    terms = [number(c.numerator) / c.denominator * _Z**k for k, c in enumerate(known)]
    polynomial = sum(terms, start=number(0))
    factors = factors_in(polynomial, _Z)
    if factors:
        parts = [
            root for each, times in factors for root in roots_of(_in_order(coefficients(each, _Z))) * times
        ]
        return [*found, *parts]
    return [*found, *(_indexed_root(polynomial, k) for k in range(1, degree + 1))]


def _indexed_root(polynomial: Expr, index: int) -> Unevaluated:
    """Return ``RootOf(p(_Z), index = k)``."""
    return Unevaluated(symbol("RootOf"), (polynomial, Relation("=", symbol("index"), number(index))))


def _rational_root(known: list[Fraction]) -> Fraction | None:
    if not known[0]:
        return Fraction(0)
    leading = abs((known[-1] / _content(known)).numerator)
    for root in numeric_roots([number(c.numerator) / c.denominator for c in known]):
        candidate = Fraction(round(root.real * leading), leading) if abs(root.imag) < 1e-6 else None
        if candidate is not None and not sum(c * candidate**k for k, c in enumerate(known)):
            return candidate
    return None


def _content(known: list[Fraction]) -> Fraction:
    """Return the number by which a polynomial is divided to have integers without a common factor."""
    below = lcm(*(c.denominator for c in known))
    return Fraction(gcd(*((c * below).numerator for c in known)), below)


def _divided(known: list[Fraction], root: Fraction) -> list[Fraction]:
    quotient: list[Fraction] = []
    carry = Fraction(0)
    for c in reversed(known):
        carry = carry * root + c
        quotient.append(carry)
    return quotient[-2::-1]


def _quadratic(c: Fraction, b: Fraction, a: Fraction) -> list[Expr]:
    middle, square = -b / (2 * a), (b * b - 4 * a * c) / (4 * a * a)
    root = _root(number(square.numerator) / square.denominator)
    centre = number(middle.numerator) / middle.denominator
    return [centre + root, centre - root]


def _root(value: Expr) -> Expr:
    half = number(1) / 2
    known = as_float(value)
    return root_of_negative(value, half) if known is not None and known < 0 else value**half


def numeric_roots(known: Sequence[Expr]) -> list[complex]:
    """Return the roots of a polynomial with numbers, in Maple's order: by angle, then by size.

    Coefficients are given with the constant first.
    """
    values = [as_float(each) for each in known]
    numbers = [0.0 if each is None else each for each in values]
    roots = [complex(each) for each in np.roots(numbers[::-1])]
    roots = [complex(each.real, 0.0) if abs(each.imag) < 1e-10 * abs(each) else each for each in roots]
    return sorted(roots, key=lambda each: (round(angle_of(each), 8), abs(each)))


def root_number(value: Value, digits: int) -> Value:
    """Return ``RootOf(p(_Z), index = k)`` as a number, where p has numbers only; other values as they are."""
    if not isinstance(value, Unevaluated) or getattr(value.function, "name", "") != "RootOf":
        return value
    polynomial, *options = value.arguments
    known = polynomial_in(polynomial, _Z) if isinstance(polynomial, Expr) else None
    if known is None or not all(each.is_constant for each in known):
        return value
    index = next((as_integer(each.right) for each in options if isinstance(each, Relation)), 1) or 1
    roots = numeric_roots(known)
    return of_number(roots[index - 1], digits) if 0 < index <= len(roots) else value


# --- equations in which the unknown occurs once -----------------------------------------------------------------------

_INVERSES: dict[str, Callable[[Expr], Expr]] = {
    "exp": log,
    "ln": exp,
    "sin": asin,
    "cos": acos,
    "tan": atan,
    "arcsin": sin,
    "arccos": cos,
    "arctan": tan,
}


_VALUES: dict[str, tuple[float, float]] = {
    "root": (0.0, math.inf),
    "arcsin": (-math.pi / 2, math.pi / 2),
    "arccos": (0.0, math.pi),
    "arctan": (-math.pi / 2, math.pi / 2),
}
"""The least and the largest real value of functions that have one."""


def _is_value_of(name: str, side: Expr) -> bool:
    """Whether a function may have a value: no number shows that it can't."""
    low, high = _VALUES.get(name, (-math.inf, math.inf))
    return not side.is_constant or low <= side.evaluate() <= high


def _peeled(residual: Expr, unknown: Expr) -> list[Value] | None:
    """Return the roots of an equation in which the unknown occurs once, by the inverses of what is around it."""
    tree = tree_of(residual)
    holding = {id(tree_of(unknown))}
    for node in walk(tree):
        inner = [part for part in node.parts if id(part) in holding]
        if len(inner) > 1:
            return None
        if inner:
            holding.add(id(node))
    sides: list[Expr] = [number(0)]
    while tree.value != unknown:
        step = next((part for part in tree.parts if id(part) in holding), None)
        made = _undone(tree, step, sides) if step is not None else None
        if made is None or step is None:
            return None
        tree, sides = step, made
    return list(sides)


def _undone(tree: Tree, inner: Tree, sides: list[Expr]) -> list[Expr] | None:
    others = [part.value for part in tree.parts if part is not inner]
    if tree.kind == "sum":
        return [side - sum(others, start=number(0)) for side in sides]
    if tree.kind == "product":
        for other in others:
            sides = [side / other for side in sides]
        return sides
    if tree.kind == "power" and tree.parts[0] is inner:
        return _unraised(tree.parts[1].value, sides)
    if tree.kind == "function" and len(tree.parts) == 1 and tree.name in _INVERSES:
        inverse = _INVERSES[tree.name]
        sides = [side for side in sides if _is_value_of(tree.name, side)]
        return [beyond_the_reals(inverse.__name__, side) or inverse(side) for side in sides]
    return None


def _unraised(exponent: Expr, sides: list[Expr]) -> list[Expr] | None:
    if not exponent.is_number:
        return [side ** (1 / exponent) for side in sides]
    numerator, denominator = exponent.ratio
    if abs(numerator) == 1:
        sides = [side for side in sides if denominator == 1 or _is_value_of("root", side)]
        return [side ** (denominator * numerator) for side in sides]
    if abs(numerator) == 2:
        roots = [side ** (number(denominator) / numerator) for side in sides]
        return [signed for each in roots for signed in (each, -each)]
    return None


def is_complex(values: Sequence[Value]) -> bool:
    """Whether I occurs in one of the roots."""
    return any(isinstance(each, Expr) and I in each.free_symbols for each in values)
