"""Assignments as ``save`` writes them: complete, in one-dimensional notation, so that ``read`` takes them back."""

from __future__ import annotations

from typing import TYPE_CHECKING

from symbody.worksheet.printing.print import PLAIN, bounded_text, name_text, text_of
from symbody.worksheet.values.value import (
    Array,
    Listed,
    MapleSet,
    Reference,
    Relation,
    Sequence,
    Table,
    Value,
)

if TYPE_CHECKING:
    from symbody.worksheet.evaluation.session import Session

__all__ = ["saved_text"]


def saved_text(session: Session, name: str) -> str:
    """Return the assignment of a name, and of the entries of its remember table."""
    value = session.names.get(name)
    lines = [] if value is None else [f"{name_text(name)} := {_text(session, session.current(value))};\n"]
    for arguments, entry in session.remembered.get(name, {}).items():
        inner = ",".join(text_of(each, PLAIN) for each in arguments)
        lines.append(f"{name_text(name)}({inner}) := {_text(session, entry)};\n")
    return "".join(lines)


def _text(session: Session, value: Value) -> str:
    if isinstance(value, Table):
        entries = [
            f"({_key(key)})=({_text(session, _field(session, entry))})"
            for key, entry in value.entries.items()
        ]
        return f"table([{', '.join(entries)}])"
    if isinstance(value, Array):
        return _array(session, value)
    if isinstance(value, Listed):
        return f"[{_joined(session, value.items)}]"
    if isinstance(value, MapleSet):
        return f"{{{_joined(session, value.items)}}}"
    if isinstance(value, Sequence):
        return _joined(session, value.items) or "NULL"
    if isinstance(value, Relation):
        return f"{_text(session, value.left)} {value.operator} {_text(session, value.right)}"
    return text_of(value, PLAIN)


def _field(session: Session, entry: Value) -> Value:
    return entry if isinstance(entry, Reference) else session.current(entry)


def _joined(session: Session, items: tuple[Value, ...]) -> str:
    return ", ".join(_text(session, each) for each in items)


def _key(key: tuple[Value, ...]) -> str:
    return ", ".join(text_of(each, PLAIN) for each in key)


def _array(session: Session, array: Array) -> str:
    texts = [_text(session, session.current(each)) for each in array.entries]
    rows = [f"[{', '.join(texts[i * array.columns : (i + 1) * array.columns])}]" for i in range(array.rows)]
    names = ", ".join(text_of(each, PLAIN) for each in array.attributes)
    attributes = f", attributes = [{names}]" if names else ""
    if array.first != (1, 1):
        return bounded_text(array, texts)
    if array.kind == "Vector":
        return f"Vector({array.rows}, [{', '.join(texts)}]{attributes})"
    if array.kind == "RowVector":
        return f"Vector[row]({array.columns}, [{', '.join(texts)}]{attributes})"
    if array.kind == "vector":
        return f"vector([{', '.join(texts)}])"
    kind = "Matrix" if array.kind == "Matrix" else "matrix"
    return f"{kind}({array.rows}, {array.columns}, [{', '.join(rows)}]{attributes})"
