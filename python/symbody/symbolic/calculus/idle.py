"""Idle symbols: those in the form of an expression on which its value doesn't depend."""

from __future__ import annotations

from collections.abc import Sequence

from symbody.symbolic import _core
from symbody.symbolic._core import Expr
from symbody.symbolic.calculus.cost import cost
from symbody.symbolic.expression.derivation import derivation
from symbody.symbolic.expression.leaves import ExprLike

__all__ = ["idle_symbols", "without_idle_symbols"]


def idle_symbols(expressions: Sequence[ExprLike]) -> tuple[Expr, ...]:
    """Return the symbols and functions of time in the forms of expressions on which none of their values depends.

    A symbol may be missing whose absence follows from a law of moduli, variable powers or solutions of linear systems.

    >>> from symbody import symbols
    >>> from symbody.symbolic import idle_symbols
    >>> a, b, c = symbols("a b c")
    >>> idle_symbols([(a * b + a * c) / (b + c)]), idle_symbols([(a * b + a * c) / (b + c), b])
    ((b, c), (c,))
    """
    return _core.idle_symbols(expressions)


def without_idle_symbols(expressions: Sequence[Expr]) -> tuple[Expr, ...]:
    """Return expressions of the same values without symbols that are idle in all of them.

    A number takes the place of an idle symbol. A form is taken only if its value is proved to be the same, if it
    divides by nothing by which the given one doesn't, and if all expressions together take no more operations.
    Otherwise the symbol stays.

    >>> from symbody import symbols
    >>> from symbody.symbolic import without_idle_symbols
    >>> a, b, c = symbols("a b c")
    >>> without_idle_symbols([(a * b + a * c) / (b + c)])
    (a,)
    """
    if not idle_symbols(expressions):
        return tuple(expressions)
    forms = _core.without_idle_symbols(expressions, deriving=False)
    with derivation(fresh=True):  # which makes one node of what has become equal, but keeps longer forms
        values = _core.without_idle_symbols(expressions, deriving=True)
    return values if cost(values).total < cost(forms).total else forms
