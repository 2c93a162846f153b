"""Results of commands in their shortest form: as the layers make it, or as a reader would write it."""

from __future__ import annotations

from collections.abc import Iterable

from symbody.symbolic import Expr, simplify
from symbody.symbolic.calculus.rewrite import short_form

__all__ = ["shortest"]

_LONG = 4000
"""Characters from which a result stays as it is: nobody reads it, and rewriting it takes longer than making it."""
_SHORT = 250
"""Characters up to which simplifying takes no time that anybody notices."""


def shortest(expressions: Iterable[Expr]) -> tuple[Expr, ...]:
    """Return each expression, or an equal one that is shorter.

    >>> from symbody import cos, functions_of_time, sin, symbols, t
    >>> (x, y, phi), m = functions_of_time("x y phi"), symbols("m")
    >>> u, v = x.diff(t) * cos(phi) + y.diff(t) * sin(phi), y.diff(t) * cos(phi) - x.diff(t) * sin(phi)
    >>> shortest([m * (u**2 + v**2) / 2])[0]
    m*(x'**2 + y'**2)/2
    """
    return tuple(_known_or_shorter(each) for each in expressions)


_known: dict[int, Expr] = {}
"""The shortest forms that were found, by the nodes: sheets ask for the components of one vector again and again."""


def _known_or_shorter(expression: Expr) -> Expr:
    if len(_known) > 200_000:
        _known.clear()
    if expression.id not in _known:
        _known[expression.id] = _shorter(expression)
    return _known[expression.id]


def _shorter(expression: Expr) -> Expr:
    length = len(str(expression))
    if expression.is_variable or expression.is_number or length > _LONG:
        return expression
    found = short_form(expression)
    candidates = [expression, found, *([simplify(found)] if len(str(found)) < _SHORT else [])]
    return min(candidates, key=lambda each: len(str(each)))
