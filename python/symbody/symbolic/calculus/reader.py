"""Forms for the reader, one for each value: a quantity that occurs again is written as before."""

from __future__ import annotations

from symbody.symbolic._core import Expr

from .cost import cost
from .rewrite import textbook_form

_LARGE = 150
"""Operations from which on an expression stays as it is: nobody reads it."""
_TOTAL = 2500
"""Operations of all expressions together, after which only small ones are rewritten."""
_SMALL = 12


class Reader:
    """Finds the forms of a set of equations; opposite values have opposite forms.

    The work is bounded by the operations of what is read, so that the result depends on the equations alone.
    """

    def __init__(self) -> None:
        self._known: dict[Expr, Expr] = {}
        self._read = 0

    def __call__(self, expression: Expr) -> Expr:
        """Return the form for the reader."""
        known = self._known.get(expression)
        if known is None:
            opposite = self._known.get(-expression)
            known = self._form(expression) if opposite is None else -opposite
            self._known[expression] = known
        return known

    def _form(self, expression: Expr) -> Expr:
        operations = cost(expression).total
        if operations > (_LARGE if self._read <= _TOTAL else _SMALL):
            return expression
        self._read += operations
        return textbook_form(expression)
