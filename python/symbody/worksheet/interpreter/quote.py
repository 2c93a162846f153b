"""Quotes: expressions that are kept as they are written."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from symbody.symbolic import Expr
from symbody.worksheet import builtins
from symbody.worksheet.evaluation.current import flattened, set_of
from symbody.worksheet.evaluation.session import Session, sequence
from symbody.worksheet.interpreter.call import application
from symbody.worksheet.interpreter.concatenation import names_of
from symbody.worksheet.interpreter.quoted_name import at_entry, head_in_quotes
from symbody.worksheet.sheet import syntax
from symbody.worksheet.values.naming import symbol
from symbody.worksheet.values.value import Listed, Quoted, Value

__all__ = ["METHODS", "unevaluated"]


def unevaluated(session: Session, node: syntax.Expression) -> Value:
    """Return what quotes keep: a name, a call of what isn't a command, or code as it is written."""
    if isinstance(node, syntax.Name):
        given = at_entry(session, node.name)
        return symbol(node.name) if given is None else given
    if isinstance(node, syntax.Concatenation):
        return sequence([symbol(name) for name in names_of(session, node)])
    if isinstance(node, syntax.Integer | syntax.Decimal | syntax.Text | syntax.Ditto):
        return session.evaluate(node)
    if isinstance(node, syntax.ListDisplay | syntax.SetDisplay | syntax.SequenceDisplay):
        items = flattened(unevaluated(session, item) for item in node.items)
        if isinstance(node, syntax.SetDisplay):
            return set_of(items)
        return Listed(tuple(items)) if isinstance(node, syntax.ListDisplay) else sequence(items)
    if isinstance(node, syntax.Selection) and isinstance(node.whole, syntax.Name | syntax.Selection):
        return _entry(session, node)
    if isinstance(node, syntax.Call) and isinstance(node.function, syntax.Name | syntax.Concatenation):
        return _kept_call(session, node)
    return Quoted(node)


def _kept_call(session: Session, node: syntax.Call) -> Value:
    arguments = flattened(unevaluated(session, each) for each in node.arguments)
    names = names_of(session, node.function) if isinstance(node.function, syntax.Concatenation) else []
    if len(names) > 1 and all(isinstance(each, Expr) for each in arguments):
        return sequence([application(session, name, tuple(arguments)) for name in names])
    name = head_in_quotes(session, node.function)
    if builtins.command(session, name) is None and all(isinstance(each, Expr) for each in arguments):
        return application(session, name, tuple(arguments))
    if _has_given(session, node):  # unevaluated code would be evaluated outside of the procedure
        return session.call(symbol(name), tuple(arguments))
    return Quoted(node)


def _has_given(session: Session, node: syntax.Call) -> bool:
    """Whether the head or an argument of a call is a name that is known in a procedure only."""
    parts = (node.function, *node.arguments)
    return any(isinstance(each, syntax.Name) and at_entry(session, each.name) is not None for each in parts)


def _entry(session: Session, node: syntax.Selection) -> Value:
    """Return the name of an entry, also of one within an entry: ``'T[1][b]'``."""
    whole = node.whole.name if isinstance(node.whole, syntax.Name) else unevaluated(session, node.whole)
    if not isinstance(whole, str | Expr):
        return Quoted(node)
    base = str(getattr(whole, "name", whole))
    indices = flattened(unevaluated(session, each) for each in node.indices)
    name = f"{base}[{','.join(session.text(each) for each in indices)}]"
    session.indexed[name] = (base, tuple(indices))
    return symbol(name)


METHODS: dict[type, Callable[[Session, Any], Value]] = {
    syntax.Delayed: lambda session, node: unevaluated(session, node.body),
}
