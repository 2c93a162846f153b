"""Parts of values by their type: found, asked for, and replaced."""

from __future__ import annotations

from collections.abc import Iterable

from symbody.symbolic import Expr
from symbody.worksheet.builtins.substitution import substituted
from symbody.worksheet.evaluation.condition import is_type
from symbody.worksheet.evaluation.current import set_of
from symbody.worksheet.evaluation.entrywise import parts_of
from symbody.worksheet.evaluation.session import Command, Session
from symbody.worksheet.values.structure import leaves, tree_of, walk
from symbody.worksheet.values.value import Array, Boolean, MapleSet, Reference, Table, Value

__all__ = ["COMMANDS"]


def indets(session: Session, value: Value, kind: Value | None = None) -> Value:
    """indets(e), indets(e, 'function'): names and functions that occur; those of a type."""
    found: list[Value] = []
    for each in _scalars(session, value):
        if kind is None:
            found.extend(leaf for leaf in leaves(each) if not leaf.is_number)
        else:
            found.extend(node.value for node in walk(tree_of(each)) if is_type(session, node.value, kind))
    return set_of(each for each in found if not (isinstance(each, Expr) and each.kind == "constant"))


def _scalars(session: Session, value: Value) -> Iterable[Expr]:
    if isinstance(value, Expr):
        yield value
        return
    found = session.resolve(value)
    parts = (
        found.entries.values()
        if isinstance(found, Table)
        else found.entries
        if isinstance(found, Array)
        else parts_of(found)
    )
    for part in parts:
        if not isinstance(part, Reference):
            yield from _scalars(session, session.current(part))


def has_part(session: Session, value: Value, kind: Value) -> Value:
    """hastype(e, t): whether a part is of a type."""
    found = indets(session, value, kind)
    return Boolean(isinstance(found, MapleSet) and bool(found.items))


def replaced(session: Session, value: Value, kind: Value, function: Value, *rest: Value) -> Value:
    """subsindets(e, t, f): each part of a type replaced by f of it, the smallest ones first."""
    parts = [
        node.value
        for each in _scalars(session, value)
        for node in walk(tree_of(each))
        if is_type(session, node.value, kind)
    ]
    for part in dict.fromkeys(parts):
        value = substituted(session, value, {part: session.call(function, (part, *rest))})
    return value


COMMANDS: dict[str, Command] = {"indets": indets, "hastype": has_part, "subsindets": replaced}
