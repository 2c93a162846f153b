"""Numerators: equations without quotients."""

from __future__ import annotations

from symbody.symbolic._core import Expr
from symbody.symbolic.expression.functions import cos, sin
from symbody.symbolic.expression.leaves import number

__all__ = ["numerator"]


def numerator(expression: Expr, unknowns: frozenset[Expr]) -> Expr:
    """Return an expression times the denominators in it that hold unknowns; tan becomes sin over cos.

    >>> from symbody.symbolic import symbols
    >>> x, a = symbols("x a")
    >>> numerator(a / x - 1 / a, frozenset({x})) == a - x / a
    True
    """
    return _parts(expression, unknowns)[0]


def _parts(e: Expr, unknowns: frozenset[Expr]) -> tuple[Expr, Expr]:
    one = number(1)
    if not e.free_symbols & unknowns:
        return e, one
    if e.kind == "sum":
        top, bottom = number(0), one
        for term in e.args:
            above, below = _parts(term, unknowns)
            if below == bottom:
                top += above
            else:
                top, bottom = top * below + above * bottom, bottom * below
        return top, bottom
    if e.kind == "product":
        top, bottom = one, one
        for factor in e.args:
            above, below = _parts(factor, unknowns)
            top, bottom = top * above, bottom * below
        return top, bottom
    if e.kind == "power" and e.args[1].is_number:
        n = e.args[1]
        above, below = _parts(e.args[0], unknowns)
        if n.ratio[1] == 1:
            return (above**n, below**n) if float(n) > 0 else (below**-n, above**-n)
        return (e, one) if float(n) > 0 else (one, e.args[0] ** -n)
    if e.kind == "function" and e.name == "tan":
        return sin(e.args[0]), cos(e.args[0])
    return e, one
