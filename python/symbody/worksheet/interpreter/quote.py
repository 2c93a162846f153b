"""Quotes: expressions that are kept as they are written."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from symbody.symbolic import Expr
from symbody.worksheet import builtins
from symbody.worksheet.evaluation.current import flattened, set_of
from symbody.worksheet.evaluation.session import Session, sequence
from symbody.worksheet.interpreter.call import application
from symbody.worksheet.interpreter.concatenation import concatenation
from symbody.worksheet.sheet import syntax
from symbody.worksheet.values.naming import symbol
from symbody.worksheet.values.value import Listed, Quoted, Value

__all__ = ["METHODS", "unevaluated"]


def unevaluated(session: Session, node: syntax.Expression) -> Value:
    """Return what quotes keep: a name, a call of what isn't a command, or code as it is written."""
    if isinstance(node, syntax.Name):
        return symbol(node.name)
    if isinstance(node, syntax.Concatenation):
        return symbol(concatenation(session, node))
    if isinstance(node, syntax.Integer | syntax.Decimal | syntax.Text | syntax.Ditto):
        return session.evaluate(node)
    if isinstance(node, syntax.ListDisplay | syntax.SetDisplay | syntax.SequenceDisplay):
        items = flattened(unevaluated(session, item) for item in node.items)
        if isinstance(node, syntax.SetDisplay):
            return set_of(items)
        return Listed(tuple(items)) if isinstance(node, syntax.ListDisplay) else sequence(items)
    if isinstance(node, syntax.Selection) and isinstance(node.whole, syntax.Name):
        return _entry(session, node)
    if isinstance(node, syntax.Call) and isinstance(node.function, syntax.Name | syntax.Concatenation):
        name = concatenation(session, node.function)
        arguments = [unevaluated(session, each) for each in node.arguments]
        if builtins.command(session, name) is None and all(isinstance(each, Expr) for each in arguments):
            return application(session, name, tuple(arguments))
    return Quoted(node)


def _entry(session: Session, node: syntax.Selection) -> Value:
    assert isinstance(node.whole, syntax.Name)
    indices = flattened(unevaluated(session, each) for each in node.indices)
    text = ",".join(session.text(each) for each in indices)
    name = f"{node.whole.name}[{text}]"
    session.indexed[name] = (node.whole.name, tuple(indices))
    return symbol(name)


METHODS: dict[type, Callable[[Session, Any], Value]] = {
    syntax.Delayed: lambda session, node: unevaluated(session, node.body),
}
