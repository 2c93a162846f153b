"""Names in quotes: there, too, a call of a procedure replaces its parameters by its arguments."""

from __future__ import annotations

from symbody.worksheet.evaluation.session import Session
from symbody.worksheet.interpreter.concatenation import concatenation
from symbody.worksheet.interpreter.leaf import OF_CALLS, named
from symbody.worksheet.sheet import syntax
from symbody.worksheet.values.value import Value

__all__ = ["at_entry", "head_in_quotes"]


def at_entry(session: Session, name: str) -> Value | None:
    """Return the value by which a call replaces a parameter, args, nargs or procname; None for other names."""
    if name in OF_CALLS and session.scopes:
        return named(session, name)
    scope = session.scope
    while scope is not None:
        if name in scope.parameters:
            return scope.names[name]
        if name in scope.local or name in scope.names:
            return None
        scope = scope.parent
    return None


def head_in_quotes(session: Session, node: syntax.Expression) -> str:
    """Return the name of the function in ``'f(x)'`` and ``'f'(x)'``."""
    given = at_entry(session, node.name) if isinstance(node, syntax.Name) else None
    return concatenation(session, node) if given is None else str(getattr(given, "name", session.text(given)))
