"""Fractions before brackets: ``(5*m + 4*M)/4`` for ``5*m/4 + M``."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from math import gcd, lcm

from symbody.symbolic import _core
from symbody.symbolic._core import Expr

from .reading import nodes_of, parts_of
from .summands import summands


def with_fractions_outside(form: Expr) -> Expr:
    """Return a product in whose sums no term has a fraction: one fraction stands before all of it.

    >>> from symbody import symbols
    >>> m, M, l = symbols("m M l")
    >>> with_fractions_outside(l**2 * (5 * m / 4 + M))
    (4*M + 5*m)*l**2/4
    >>> with_fractions_outside(l**2 * (2 * m / 3 + 2 * M)), with_fractions_outside(l * (0.3 * m - 0.3 * M))
    (2*(3*M + m)*l**2/3, 0.3*l*(m - M))
    """
    made, outside = list[Expr](), list[Expr]()
    for factor in parts_of(form, "product"):
        terms = parts_of(factor, "sum")
        common = _common_number(terms) if len(terms) > 1 else None
        made.append(factor if common is None else _core.sum_of([term / common for term in terms]))
        outside += [] if common is None else [common]
    return _core.product_of([*outside, *made]) if outside else form


def with_fraction_inside(form: Expr) -> Expr | None:
    """Return a product whose fraction is within the only sum, if what moves stands before that; otherwise None.

    >>> from symbody import cos, functions_of_time, symbols
    >>> (q, s), (m, l) = functions_of_time("q s"), symbols("m l")
    >>> with_fraction_inside((2 * m * s + m * l) * cos(q) / 2), with_fraction_inside(m * (2 + 3 * cos(q)) / 6)
    ((m*s + l*m/2)*cos(q), None)
    """
    factors = parts_of(form, "product")
    sums = [factor for factor in factors if factor.kind == "sum"]
    numbers = [factor for factor in factors if factor.is_number]
    others = [factor for factor in factors if factor.kind != "sum" and not factor.is_number]
    if len(sums) != 1 or not numbers or not _moves(sums[0]) or not any(map(_moves, others)):
        return None
    inside = _core.sum_of([_core.product_of([*numbers, term]) for term in summands(sums[0])])
    return _core.product_of([*others, inside])


def _moves(factor: Expr) -> bool:
    return any(leaf.kind == "time_function" for leaf in factor.free_symbols)


def with_numbers_inside(form: Expr) -> Expr:
    """Return a form whose sums of parameters have no numbers before brackets.

    >>> from symbody import symbols
    >>> a, b, c, d = symbols("a b c d")
    >>> with_numbers_inside(d * (a + 2 * (b + c)))
    d*(a + 2*b + 2*c)
    """
    made = dict[int, Expr]()
    for node in nodes_of(form):
        args = [made[arg.id] for arg in node.args]
        is_changed = any(new.id != old.id for new, old in zip(args, node.args, strict=True))
        if node.kind == "sum" and _is_nested(args):
            made[node.id] = _core.sum_of([term for arg in args for term in summands(arg)])
        elif is_changed and node.kind in _MAKE:
            made[node.id] = _MAKE[node.kind](args)
        else:
            made[node.id] = node
    found = made[form.id]
    return found if found == form else form


_MAKE = {"sum": _core.sum_of, "product": _core.product_of}


def _is_nested(terms: Sequence[Expr]) -> bool:
    """Return whether a term is a number times a sum, and all are of parameters to the first power."""
    parts = [summands(term) for term in terms]
    factors = ([f for f in parts_of(part, "product") if not f.is_number] for each in parts for part in each)
    is_linear = all(len(each) == 1 and each[0].kind == "symbol" for each in factors)
    return is_linear and any(len(each) > 1 for each in parts)


def with_number_outside(total: Expr) -> Expr:
    """Return a sum with the number outside that all its terms have as a factor.

    >>> from symbody import symbols
    >>> m, M = symbols("m M")
    >>> with_number_outside(2 * m / 3 + 2 * M)
    2*(3*M + m)/3
    """
    terms = summands(total)
    numbers = [Fraction(*_number(term).ratio) for term in terms]
    if len(terms) == 1 or any(_number(term).is_decimal for term in terms):
        return total
    common = Fraction(gcd(*(n.numerator for n in numbers)), lcm(*(n.denominator for n in numbers)))
    if common == 1:
        return total
    return _core.number(common) * _core.sum_of([term / common for term in terms])


def _number(term: Expr) -> Expr:
    return _core.product_of([part for part in parts_of(term, "product") if part.is_number])


def _common_number(terms: Sequence[Expr]) -> Expr | None:
    """Return the fraction that the numbers of terms have in common, or the decimal that all of them are up to sign."""
    common = _common_fraction(terms)
    return _common_decimal(terms) if common == 1 else _core.number(common)


def with_decimal_outside(total: Expr) -> Expr:
    """Return a sum with the decimal outside that all its terms have as a factor.

    >>> from symbody import symbols
    >>> m, M = symbols("m M")
    >>> with_decimal_outside(0.3 * m - 0.3 * M)
    0.3*(m - M)
    """
    terms = summands(total)
    common = _common_decimal(terms) if len(terms) > 1 else None
    return total if common is None else common * _core.sum_of([term / common for term in terms])


def _common_decimal(terms: Sequence[Expr]) -> Expr | None:
    first, *others = map(_number, terms)
    return abs(first) if first.is_decimal and all(abs(other) == abs(first) for other in others) else None


def _common_fraction(terms: Sequence[Expr]) -> Fraction:
    """Return the fraction that the numbers of terms have in common; 1 if none of them is a fraction."""
    numbers = [_number(term) for term in terms]
    denominator = lcm(*map(_denominator, terms))
    is_exact = not any(each.is_decimal for each in numbers)
    numerator = gcd(*(each.ratio[0] for each in numbers)) if is_exact else 1
    return Fraction(numerator, denominator) if denominator > 1 else Fraction(1)


def _denominator(term: Expr) -> int:
    numbers = (part for part in parts_of(term, "product") if part.is_number and not part.is_decimal)
    return lcm(*(part.ratio[1] for part in numbers))
