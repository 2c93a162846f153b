"""Matrices with scalars and blocks on their diagonal: DiagonalMatrix, diag."""

from __future__ import annotations

from collections.abc import Iterable

from symbody.errors import WorksheetError
from symbody.worksheet.builtins.arrays import filled
from symbody.worksheet.evaluation.entrywise import parts_of
from symbody.worksheet.evaluation.session import Command, Session
from symbody.worksheet.values.numeric import as_integer
from symbody.worksheet.values.value import Array, Listed, Value

__all__ = ["PACKAGES"]


def diagonal_matrix(
    session: Session, items: Value, rows: Value | None = None, columns: Value | None = None
) -> Value:
    """DiagonalMatrix([a, B, ..], n, m): scalars and matrices on the diagonal, in n rows and m columns.

    Args:
        session: the session.
        items: a list or a vector.
        rows: n; as many as the items need by default.
        columns: m, n by default.
    """
    found = session.resolve(items)
    sizes = [as_integer(each) for each in (rows, columns or rows) if each is not None]
    return _with_blocks(session, _items(found) or [found], "Matrix", [each or 0 for each in sizes])


def diag(session: Session, *values: Value) -> Value:
    """diag(a, B, ..): scalars and matrices on the diagonal; those of lists and vectors, too."""
    items = [item for value in values for item in _items(session.resolve(value)) or [session.resolve(value)]]
    return _with_blocks(session, items, "matrix", [])


def _items(value: Value) -> list[Value]:
    """Return the items of a list or of a vector; none of a scalar or a matrix."""
    if isinstance(value, Array):
        return list(value.entries) if "ector" in value.kind else []
    return list(parts_of(value)) if isinstance(value, Listed) else []


def _with_blocks(session: Session, items: Iterable[Value], kind: str, sizes: list[int]) -> Array:
    blocks = [
        each if isinstance(each, Array) else Array(1, 1, [each]) for each in map(session.resolve, items)
    ]
    needed = sum(each.rows for each in blocks), sum(each.columns for each in blocks)
    rows, columns = sizes or needed
    if rows < needed[0] or columns < needed[1]:
        raise WorksheetError(
            f"DiagonalMatrix: a diagonal of {needed[0]} x {needed[1]} for a size of {rows} x {columns}"
        )
    made = filled(session, rows, columns, None, kind)
    row = column = 0
    for block in blocks:
        for i in range(block.rows):
            start = (row + i) * columns + column
            made.entries[start : start + block.columns] = [
                session.current(each) for each in block.entries[i * block.columns : (i + 1) * block.columns]
            ]
        row, column = row + block.rows, column + block.columns
    return made


PACKAGES: dict[str, dict[str, Command]] = {
    "LinearAlgebra": {"DiagonalMatrix": diagonal_matrix},
    "linalg": {"diag": diag},
}
