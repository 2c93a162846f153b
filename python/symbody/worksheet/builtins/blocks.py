"""Matrices of blocks side by side and below each other: ``<A, B>``, ``<A | B>``, ``Matrix([[A, B], [C, D]])``."""

from __future__ import annotations

from collections.abc import Sequence as Items

from symbody.errors import WorksheetError
from symbody.worksheet.evaluation.session import Session
from symbody.worksheet.values.value import Array, Listed, Sequence, Value

__all__ = ["from_columns", "from_rows", "of_blocks"]


def from_columns(session: Session, items: tuple[Value, ...]) -> Value:
    """Return ``<a, b>``: a column; of rows, a matrix."""
    parts = [session.resolve(each) for each in items]
    if any(isinstance(each, Array) for each in parts):
        return _below_each_other(session, _arrays(parts))
    flat = [
        each for part in parts for each in (part.items if isinstance(part, Listed | Sequence) else (part,))
    ]
    flat = [items[i] for i in range(len(items))] if len(flat) == len(items) else flat
    return Array(len(flat), 1, list(flat), "Vector")


def from_rows(session: Session, items: tuple[Value, ...]) -> Value:
    """Return ``<a | b>``: a row; of columns, a matrix."""
    parts = [session.resolve(each) for each in items]
    if not any(isinstance(each, Array) for each in parts):
        return Array(1, len(items), list(items), "RowVector")
    return _side_by_side(session, _arrays(parts))


def of_blocks(session: Session, rows: Listed) -> Array | None:
    """Return the matrix of a list of rows or columns, or of rows of blocks; None if no entry is an array."""
    parts = [session.resolve(each) for each in rows.items]
    if parts and all(isinstance(each, Array) for each in parts):
        arrays = _arrays(parts)
        if all(each.kind == "RowVector" for each in arrays):
            return _below_each_other(session, arrays)
        return _side_by_side(session, arrays)
    lines = [[session.resolve(each) for each in part.items] for part in parts if isinstance(part, Listed)]
    if len(lines) < len(parts) or not any(isinstance(each, Array) for line in lines for each in line):
        return None
    return _below_each_other(session, [_side_by_side(session, _arrays(line)) for line in lines])


def _arrays(parts: Items[Value]) -> list[Array]:
    return [each if isinstance(each, Array) else Array(1, 1, [each]) for each in parts]


def _below_each_other(session: Session, arrays: Items[Array]) -> Array:
    columns = _common({each.columns for each in arrays}, "columns", "below each other")
    entries = [session.current(entry) for each in arrays for entry in each.entries]
    rows = sum(each.rows for each in arrays)
    return Array(rows, columns, entries, "Vector" if columns == 1 else "Matrix")


def _side_by_side(session: Session, arrays: Items[Array]) -> Array:
    rows = _common({each.rows for each in arrays}, "rows", "side by side")
    entries = [
        session.current(each.entries[i * each.columns + j])
        for i in range(rows)
        for each in arrays
        for j in range(each.columns)
    ]
    return Array(rows, sum(each.columns for each in arrays), entries, "Matrix")


def _common(counts: set[int], what: str, where: str) -> int:
    """Return the number of rows or columns that all blocks have in common."""
    if len(counts) > 1:
        told = " and ".join(map(str, sorted(counts)))
        raise WorksheetError(
            f"Matrix: blocks {where} have {told} {what}; expected the same number of {what} in each"
        )
    return counts.pop()
