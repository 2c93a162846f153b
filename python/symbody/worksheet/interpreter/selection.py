"""Entries of what a name or an expression holds: ``a[i]``, ``package:-command``."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from symbody.worksheet import builtins
from symbody.worksheet.evaluation.select import indexed_name, key_of, selected
from symbody.worksheet.evaluation.session import Session
from symbody.worksheet.interpreter.leaf import named
from symbody.worksheet.sheet import syntax
from symbody.worksheet.values.naming import symbol
from symbody.worksheet.values.value import Listed, Sequence, Table, Value

__all__ = ["METHODS"]


def _selection(session: Session, node: syntax.Selection) -> Value:
    if isinstance(node.whole, syntax.Name):
        package = builtins.package_command(session, node.whole.name, node.indices)
        if package is not None:
            return package
        whole = _whole(session, node.whole.name)
    else:
        whole = session.evaluate(node.whole)
    indices = session.evaluated(node.indices)
    if isinstance(whole, Table) and not whole.is_sparse and key_of(session, indices) not in whole.entries:
        whole = _name(session, node.whole) or whole
    found = selected(session, whole, indices)
    return session.current(found) if isinstance(found, Listed | Sequence) else found


def _name(session: Session, node: syntax.Expression) -> Value | None:
    """Return the name of an entry that is a table, ``T[1]``; None for what has no name."""
    match node:
        case syntax.Name(name=name) if not session.scopes or _is_local_alone(session, name):
            return symbol(name)
        case syntax.Selection(whole=inner) if (base := _name(session, inner)) is not None:
            return indexed_name(session, base, session.evaluated(node.indices))
    return None


def _is_local_alone(session: Session, name: str) -> bool:
    """Whether a name is local and none of the session, so that its entries can't be taken for those of another."""
    return name not in session.names and session.scope_of(name) is not None


def _whole(session: Session, name: str) -> Value:
    """A list of which one item is wanted isn't evaluated as a whole."""
    held = session.names.get(name) if not session.scopes and name not in session.options.aliases else None
    return held if isinstance(held, Listed) else named(session, name)


def _member(session: Session, node: syntax.Member) -> Value:
    names: list[str] = []
    package: syntax.Expression = node
    while isinstance(package, syntax.Member):
        names.insert(0, package.name)
        package = package.package
    if isinstance(package, syntax.Name):
        found = builtins.member(session, package.name, names)
        if found is not None:
            return found
        builtins.notice_unknown_member(session, package.name, node.name, is_package=True)
    return selected(session, session.evaluate(node.package), (symbol(node.name),))


METHODS: dict[type, Callable[[Session, Any], Value]] = {
    syntax.Selection: _selection,
    syntax.Member: _member,
}
