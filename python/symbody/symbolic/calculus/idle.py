"""Idle symbols: those in the form of an expression on which its value doesn't depend."""

from __future__ import annotations

from collections.abc import Sequence

from symbody.errors import ExpressionError
from symbody.symbolic import _core
from symbody.symbolic._core import Expr
from symbody.symbolic.calculus.cost import operations
from symbody.symbolic.calculus.derivative import substitute
from symbody.symbolic.expression.derivation import derivation
from symbody.symbolic.expression.leaves import ExprLike
from symbody.symbolic.expression.traverse import post_order

__all__ = [
    "idle_symbols",
    "seemingly_idle_symbols",
    "with_numbers_for_idle_symbols",
    "without_idle_symbols",
]


def idle_symbols(expressions: Sequence[ExprLike]) -> tuple[Expr, ...]:
    """Return the symbols and functions of time in the forms of expressions on which none of their values depends.

    A symbol may be missing whose absence follows from a law of moduli, variable powers or solutions of linear systems.

    >>> from symbody import symbols
    >>> from symbody.symbolic import idle_symbols
    >>> a, b, c = symbols("a b c")
    >>> idle_symbols([(a * b + a * c) / (b + c)]), idle_symbols([(a * b + a * c) / (b + c), b])
    ((b, c), (c,))
    """
    return _core.idle_symbols(expressions, surely=True)


def seemingly_idle_symbols(expressions: Sequence[Expr]) -> tuple[Expr, ...]:
    """Return all idle symbols, and sometimes others on which one branch of an expression with signs doesn't depend.

    It takes less time than `idle_symbols`: it looks at two branches.

    >>> from symbody import symbols
    >>> from symbody.symbolic import seemingly_idle_symbols
    >>> a, b, c = symbols("a b c")
    >>> seemingly_idle_symbols([(a * b + a * c) / (b + c)])
    (b, c)
    """
    return _core.idle_symbols(expressions, surely=False)


def with_numbers_for_idle_symbols(expressions: Sequence[Expr]) -> tuple[Expr, ...]:
    """Return expressions with numbers for symbols that are idle in all of them; `without_idle_symbols` looks further.

    >>> from symbody import symbols
    >>> from symbody.symbolic import with_numbers_for_idle_symbols
    >>> a, b, c = symbols("a b c")
    >>> with_numbers_for_idle_symbols([(a * b + a * c) / (b + c)])
    (a,)
    """
    return _core.without_idle_symbols(expressions, deriving=False)


def without_idle_symbols(expressions: Sequence[Expr]) -> tuple[Expr, ...]:
    """Return expressions of the same values without symbols that are idle in all of them.

    A number takes the place of an idle symbol. A form is taken only if its value is proved to be the same, if it
    divides by nothing by which the given one doesn't, and if all expressions together take no more operations.
    Otherwise the symbol stays. To divide by ``m*(a + b)`` is to divide by ``a + b``.

    >>> from symbody import symbols
    >>> from symbody.symbolic import without_idle_symbols
    >>> a, b, c = symbols("a b c")
    >>> without_idle_symbols([(a * b + a * c) / (b + c)])
    (a,)
    """
    if not seemingly_idle_symbols(expressions):
        return tuple(expressions)
    forms = with_numbers_for_idle_symbols(expressions)
    with derivation(fresh=True):  # which makes one node of what has become equal, but keeps longer forms
        values = _core.without_idle_symbols(expressions, deriving=True)
    with derivation(fresh=True):  # so that no derivation in which the forms are first needed changes them
        return _without_factors(values if operations(values) < operations(forms) else forms)


def _without_factors(expressions: tuple[Expr, ...]) -> tuple[Expr, ...]:
    """Return expressions without idle symbols that are factors of divisors, such as a common mass."""
    for symbol in idle_symbols(expressions):
        if symbol.kind == "symbol":
            expressions = next(filter(None, (_at(symbol, n, expressions) for n in _PLACES)), expressions)
    return expressions


_PLACES = (1, 2)
"""The numbers that take the place of a factor, which isn't zero."""


def _at(symbol: Expr, place: int, expressions: tuple[Expr, ...]) -> tuple[Expr, ...] | None:
    """Return expressions with a number for an idle symbol; None if they are longer, or no longer as regular."""
    if not all(_is_as_regular(node, symbol, place) for node in _divisions(expressions, symbol)):
        return None
    found = tuple(substitute(expressions, {symbol: place}))
    return found if found == expressions and operations(found) <= operations(expressions) else None


def _divisions(expressions: tuple[Expr, ...], symbol: Expr) -> list[Expr]:
    """Return the nodes that hold a symbol and have no value for some of their arguments."""
    holding, found = {symbol}, list[Expr]()
    for node in post_order(expressions, lambda node: node.args, lambda node: node.id):
        if not holding.isdisjoint(node.args):
            holding.add(node)
            is_entire = node.kind in {"sum", "product"} or (node.kind == "function" and node.name in _ENTIRE)
            if not (is_entire or _is_natural_power(node)):
                found.append(node)
    return found


_ENTIRE = {"sin", "cos", "exp"}


def _is_natural_power(node: Expr) -> bool:
    if node.kind != "power" or not node.args[1].is_number:
        return False
    numerator, denominator = node.args[1].ratio
    return numerator > 0 and denominator == 1


def _is_as_regular(node: Expr, symbol: Expr, place: int) -> bool:
    """Return whether a node with a number for a symbol has no value only where it has none with the symbol."""
    try:
        found = substitute(node.args, {symbol: place})
    except ExpressionError:
        return False
    if tuple(found) == tuple(node.args):
        return True
    is_quotient = node.kind == "power" and node.args[1].is_number and node.args[1].ratio[1] == 1
    if not is_quotient or found[0].is_zero:
        return False
    ratio = node.args[0] / found[0]
    return ratio.free_symbols - {symbol} <= {*idle_symbols([ratio])}
