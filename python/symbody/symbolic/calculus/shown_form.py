"""Forms that are shown: they hold no symbols on which the value doesn't depend."""

from __future__ import annotations

from collections.abc import Iterator

from symbody.errors import SymbodyError
from symbody.symbolic._core import Expr

from .cost import cost
from .derivative import substitute
from .idle import idle_symbols, without_idle_symbols
from .readable import readable

__all__ = ["shown_form"]


def shown_form(expression: Expr) -> Expr:
    """Return an expression as it is, or a form for the reader if it holds symbols on which its value doesn't depend.

    >>> from symbody import symbols
    >>> a, b, c = symbols("a b c")
    >>> shown_form(a * (b + c) - a * c), shown_form(a * (b + c))
    (a*b, a*(b + c))
    """
    if not idle_symbols([expression]):
        return expression
    return min(_forms(expression), key=lambda form: len(idle_symbols([form])))


def _forms(expression: Expr) -> Iterator[Expr]:
    """Yield forms of the same value; the given one comes last."""
    is_short = cost(expression).total <= _READ
    if is_short:
        yield readable(expression)
    (shorter,) = without_idle_symbols([expression])
    yield shorter
    for place in _PLACES:
        found = _at(place, expression)
        if found is not None and found == expression:
            yield readable(found) if is_short else found
    yield expression


_READ = 250
"""Operations of an expression up to which the form for the reader is looked for; it takes seconds for longer ones."""
_PLACES = (1, 2)
"""Numbers that take the place of idle symbols."""


def _at(place: int, expression: Expr) -> Expr | None:
    try:
        return substitute([expression], dict.fromkeys(idle_symbols([expression]), place))[0]
    except SymbodyError:  # undefined there
        return None
