"""Values of a session as text of Python: lists, matrices, tables, and what they hold."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from symbody.symbolic import Expr
from symbody.worksheet.convert.names import Names, NoText, identifier
from symbody.worksheet.convert.object_text import known_frame, load_text, object_text
from symbody.worksheet.convert.scalar_text import scalar_text
from symbody.worksheet.evaluation.session import Session
from symbody.worksheet.mechanics.objects import kind_of
from symbody.worksheet.values.complex_number import as_complex, has_i
from symbody.worksheet.values.value import (
    Array,
    Boolean,
    Listed,
    MapleSet,
    Reference,
    Relation,
    Sequence,
    String,
    Table,
    Value,
)

__all__ = ["literal"]


def literal(session: Session, value: Value, names: Names) -> str:
    """Return a value as text of Python.

    Raises:
        NoText: Python has no such value.
    """
    found = session.current(session.resolve(value))
    writer = _WRITERS.get(type(found))
    if writer is None:
        raise NoText(type(found).__name__)
    return writer(session, found, names)


def _equation(session: Session, value: Relation, names: Names) -> str:
    """Return ``{x: value}`` for what gives a variable a value, and ``left - right`` for another equation."""
    if value.operator != "=":
        raise NoText(value.operator)
    left, right = session.current(value.left), session.current(value.right)
    if not isinstance(left, Expr) or not isinstance(right, Expr):
        raise NoText("equation")
    if left.is_variable and not names.as_differences:
        return f"{{{scalar_text(left, names)}: {scalar_text(right, names)}}}"
    return scalar_text(left - right, names)


def _items(session: Session, value: Listed | Sequence | MapleSet, names: Names) -> str:
    return f"[{', '.join(literal(session, item, names) for item in value.items)}]"


def _set(session: Session, value: MapleSet, names: Names) -> str:
    """Return a set as a list, and one of equations, such as a solution, as a dictionary."""
    items = [item for item in value.items if isinstance(item, Relation)]
    if not items or len(items) < len(value.items):
        return _items(session, value, names)
    pairs = (f"{literal(session, i.left, names)}: {literal(session, i.right, names)}" for i in items)
    return f"{{{', '.join(pairs)}}}"


def _matrix(session: Session, value: Array, names: Names) -> str:
    if value.first != (1, 1):
        raise NoText("Array")  # matrices in Python have one first index
    if value.frame is not None and known_frame(value.frame, names):
        return known_frame(value.frame, names)
    rows = [value.entries[i * value.columns : (i + 1) * value.columns] for i in range(value.rows)]
    texts = [literal(session, Listed(tuple(row)), names) for row in rows]
    found = (session.current(each) for each in value.entries)
    if any(isinstance(each, Expr) and _number(each) for each in found):
        return f"np.array([{', '.join(texts)}])"  # a Matrix has no complex entries
    return f"sb.{'Matrix' if value.frame is None else 'Frame'}([{', '.join(texts)}])"


def _table(session: Session, value: Table, names: Names) -> str:
    """Return an object, or a table as a dictionary: names are texts there."""
    if kind_of(value) in {"POINT", "VECTOR", "BODY"}:
        return object_text(session, value, names)
    if kind_of(value) in {"FORCE", "TORQUE"}:
        return load_text(session, value, names)
    if kind_of(value):
        raise NoText(str(kind_of(value)))
    pairs = (f"{_key(key)}: {literal(session, entry, names)}" for key, entry in value.entries.items())
    return f"{{{', '.join(pairs)}}}"


def _key(key: tuple[Value, ...]) -> str:
    texts = [str(part) if str(part).isdigit() else repr(str(part)) for part in key]
    return texts[0] if len(texts) == 1 else f"({', '.join(texts)})"


def _truth(session: Session, value: Boolean, names: Names) -> str:
    if value.truth is None:
        raise NoText("FAIL")
    return str(value.truth)


def _name(session: Session, value: Reference, names: Names) -> str:
    if identifier(value.name) not in names.values:
        raise NoText(value.name)
    return identifier(value.name)


def _number(value: Expr) -> str:
    """Return a number that isn't real as Python's; nothing for another scalar."""
    found = as_complex(value) if has_i(value) else None
    return "" if found is None else repr(found)


_WRITERS: Mapping[type, Callable[[Session, Any, Names], str]] = {
    Relation: _equation,
    Listed: _items,
    Sequence: _items,
    MapleSet: _set,
    Array: _matrix,
    Table: _table,
    Boolean: _truth,
    Reference: _name,
    String: lambda session, value, names: repr(value.text),
    Expr: lambda session, value, names: _number(value) or scalar_text(value, names),
}
