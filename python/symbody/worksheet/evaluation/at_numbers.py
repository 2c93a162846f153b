"""Values of expressions at numbers, in which functions that the sheet has defined are called."""

from __future__ import annotations

from collections.abc import Mapping

from symbody.errors import SymbodyError, WorksheetError
from symbody.symbolic import Expr
from symbody.symbolic.expression.traverse import post_order
from symbody.worksheet.evaluation.session import Session
from symbody.worksheet.values.numeric import as_float, decimal
from symbody.worksheet.values.value import Value

__all__ = ["calls_functions", "function_at", "to_be_evaluated", "value_at"]

_DIGITS = 16
"""Of a double."""


def calls_functions(session: Session, expression: Expr) -> bool:
    """Whether an expression holds functions that have a definition, such as those of a numeric solution."""
    if session.names.keys().isdisjoint({leaf.name for leaf in expression.free_symbols} | session.applied):
        return False
    nodes = post_order([expression], lambda node: node.args, lambda node: node.id)
    return any(node.kind in ("application", "time_function") and node.name in session.names for node in nodes)


def value_at(session: Session, expression: Expr, values: Mapping[Expr, float]) -> float:
    """Return the value of an expression at numbers.

    Raises:
        WorksheetError: it is no number there.
    """
    if not calls_functions(session, expression):
        return float(expression.evaluate(values))
    placed = expression.subs({x: decimal(float(value), _DIGITS) for x, value in values.items()})
    return _number(session, session.current(placed))


def function_at(session: Session, function: Value, argument: float) -> float:
    """Return the value of a function at a number.

    Raises:
        WorksheetError: it is no number there.
    """
    return _number(session, session.current(session.call(function, (decimal(argument, _DIGITS),))))


def _number(session: Session, found: Value) -> float:
    result = as_float(found) if isinstance(found, Expr) else None
    if result is None:
        raise WorksheetError(f"{session.text(found)[:60]} is no number")
    return result


def to_be_evaluated(session: Session, value: Value) -> Value:
    """Return the present value of what is evaluated at numbers; ``'f(x)'`` as it is if f needs a number for x."""
    try:
        return session.current(session.resolve(value))
    except SymbodyError:
        if isinstance(value, Expr) and calls_functions(session, value):
            return value
        raise
