"""Forms for the reader: kinetic energies by products of speeds, other expressions in the form of the shortest text."""

from __future__ import annotations

from typing import Any, overload

from symbody.symbolic._core import Expr
from symbody.symbolic.expression.container import Kind, is_container, rewritten
from symbody.symbolic.expression.leaves import ExprLike
from symbody.symbolic.given.arguments import expression_or_container

from .energy_form import energy_form, flat_inertia
from .shortest_text import shortest_text
from .whole_divisors import with_whole_divisors

__all__ = ["readable"]


@overload
def readable(expression: ExprLike) -> Expr: ...
@overload
def readable(expression: Kind) -> Kind: ...
def readable(expression: Any) -> Any:
    """Return the form that a textbook would print: for the page, not for code, since it may cost more operations.

    Of a fixed list of forms, the one with the shortest text is taken; one of them has a coefficient for each
    acceleration and each product of speeds, and one is multiplied out and simplified. Multiples of angles that the
    expression does not have count as longer. The text is never longer than that of the expression, unless that has
    a factor before brackets in which it occurs again, as ``c + x*(a + b*x)``. An energy whose brackets hold sums of
    speeds in brackets has a coefficient for each product of speeds, and entries of mass matrices have flat squares of
    lengths, ``J + m*(l**2 + a*l*cos(q))``. Divisors have no fractions. Parts that are too large stay as they are. The
    value at the random point proves that the mathematics is unchanged.

    >>> from symbody import cos, readable, sin, symbols
    >>> m, l, c, a, b = symbols("m l c a b")
    >>> readable(m * (l * l + 2 * c * l * cos(a)) + m * c**2)
    m*(c**2 + l**2 + 2*c*l*cos(a))
    >>> readable(sin(a) * cos(b) + cos(a) * sin(b))
    sin(a + b)
    """
    if is_container(expression):
        return rewritten(expression, lambda parts: tuple(map(_most_readable, parts)), "readable")
    return _most_readable(expression_or_container(expression, "readable"))


def _most_readable(expression: Expr) -> Expr:
    energy = energy_form(expression)
    form = flat_inertia(expression, shortest_text(expression)) if energy is None else energy
    return with_whole_divisors(form)
