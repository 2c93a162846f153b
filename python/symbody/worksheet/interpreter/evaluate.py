"""Expressions: a method per construct, from the tables of the files beside this one."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Any

from symbody.errors import SymbodyError, WorksheetError
from symbody.symbolic import Expr
from symbody.worksheet.builtins.blocks import from_columns, from_rows
from symbody.worksheet.evaluation import arithmetic
from symbody.worksheet.evaluation.assumptions import under
from symbody.worksheet.evaluation.current import set_of
from symbody.worksheet.evaluation.select import selected
from symbody.worksheet.evaluation.session import Session, sequence
from symbody.worksheet.interpreter import call, concatenation, leaf, operation, quote, selection
from symbody.worksheet.sheet import syntax
from symbody.worksheet.values.value import Listed, Value

__all__ = ["evaluate", "install"]

_DISPLAYS: dict[type, Callable[[Session, Any], Value]] = {
    syntax.SequenceDisplay: lambda session, node: sequence(session.evaluated(node.items)),
    syntax.ListDisplay: lambda session, node: Listed(session.evaluated(node.items)),
    syntax.SetDisplay: lambda session, node: set_of(session.evaluated(node.items)),
    syntax.Columns: lambda session, node: from_columns(session, session.evaluated(node.items)),
    syntax.Rows: lambda session, node: from_rows(session, session.evaluated(node.items)),
}
_METHODS: dict[type, Callable[[Session, Any], Value]] = {
    **leaf.METHODS,
    **_DISPLAYS,
    **quote.METHODS,
    **concatenation.METHODS,
    **operation.METHODS,
    **selection.METHODS,
    **call.METHODS,
}
_DEEPEST = 2500
"""Expressions inside each other."""


def install(session: Session) -> None:
    """Let a session evaluate expressions."""
    session.call = partial(call.call, session)
    session.evaluate = partial(evaluate, session)
    session.rebuild = partial(arithmetic.rebuilt, session)
    session.select = partial(selected, session)


def evaluate(session: Session, node: syntax.Expression) -> Value:
    """Return the value of an expression."""
    limits = session.limits
    limits.nested += 1
    if limits.nested > _DEEPEST:
        limits.nested = 0
        raise WorksheetError("too many levels of recursion")
    try:
        value = _METHODS[type(node)](session, node)
        positive = session.options.positive
        return under(value, positive) if positive and isinstance(value, Expr) else value
    except WorksheetError as error:
        if error.place is None:
            error.place = node.place
        raise
    except (SymbodyError, ArithmeticError, MemoryError) as error:
        raise WorksheetError(str(error) or type(error).__name__, node.place) from error
    finally:
        limits.nested -= 1
