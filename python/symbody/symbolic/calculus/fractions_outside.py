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
    """
    factors = parts_of(form, "product")
    made, outside = list[Expr](), 1
    for factor in factors:
        terms = parts_of(factor, "sum")
        common = lcm(*map(_denominator, terms)) if len(terms) > 1 else 1
        made.append(_core.sum_of([common * term for term in terms]) if common > 1 else factor)
        outside *= common
    return form if outside == 1 else _core.number(Fraction(1, outside)) * _core.product_of(made)


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


def _denominator(term: Expr) -> int:
    numbers = (part for part in parts_of(term, "product") if part.is_number and not part.is_decimal)
    return lcm(*(part.ratio[1] for part in numbers))
