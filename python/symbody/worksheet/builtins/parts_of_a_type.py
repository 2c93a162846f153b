"""Parts of values by their type: found, asked for, and replaced."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from symbody.symbolic import Expr
from symbody.worksheet.builtins.substitution import substituted
from symbody.worksheet.evaluation.condition import is_type
from symbody.worksheet.evaluation.current import set_of
from symbody.worksheet.evaluation.entrywise import parts_of
from symbody.worksheet.evaluation.session import Command, Session
from symbody.worksheet.values.structure import tree_of, walk
from symbody.worksheet.values.value import Array, Boolean, MapleSet, Reference, Table, Value

__all__ = ["COMMANDS"]


def indets(session: Session, value: Value, kind: Value | None = None) -> Value:
    """indets(e): what a rational expression is made of, names, calls and roots; indets(e, t): parts of a type."""
    if kind is not None:
        return set_of(part for part in _parts(session, value) if is_type(session, part, kind))
    scalars = (part for part in _parts(session, value) if isinstance(part, Expr))
    return set_of(part for part in scalars if _is_unknown(part))


def _is_unknown(part: Expr) -> bool:
    """Whether a part is a name, a call or a power that no ratio of polynomials contains, and no constant."""
    tree = tree_of(part)
    if tree.kind == "power":
        exponent = tree.parts[1].value
        if exponent.is_number and exponent.ratio[1] == 1:
            return False
    elif tree.kind not in ("name", "function", "derivative"):
        return False
    return any(node.kind == "name" and node.name not in ("I", "Pi") for node in walk(tree))


def _parts(session: Session, value: Value) -> Iterator[Value]:
    """Return all parts of a value, the smallest ones first: those of scalars in it, and of calls that nobody knows."""
    if isinstance(value, Expr):
        for node in walk(tree_of(value)):
            call = session.opaque.get(node.name) if node.kind == "name" else None
            yield from (node.value,) if call is None else _parts(session, call)
        return
    if isinstance(value, Reference) and value.name not in session.names:
        return
    found = session.resolve(value)
    inner: Iterable[Value] = parts_of(found)
    if isinstance(found, Table):
        inner = found.entries.values()
    elif isinstance(found, Array):
        inner = found.entries
    for part in inner:
        if not isinstance(part, Reference):
            yield from _parts(session, session.current(part))
    yield found


def has_part(session: Session, value: Value, kind: Value) -> Value:
    """hastype(e, t): whether a part is of a type."""
    found = indets(session, value, kind)
    return Boolean(isinstance(found, MapleSet) and bool(found.items))


def replaced(session: Session, value: Value, kind: Value, function: Value, *rest: Value) -> Value:
    """subsindets(e, t, f): each part of a type replaced by f of it, the smallest ones first."""
    parts = [
        part for part in _parts(session, value) if isinstance(part, Expr) and is_type(session, part, kind)
    ]
    for part in dict.fromkeys(parts):
        value = substituted(session, value, {part: session.call(function, (part, *rest))})
    return value


COMMANDS: dict[str, Command] = {"indets": indets, "hastype": has_part, "subsindets": replaced}
