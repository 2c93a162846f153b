"""Rows and columns that are left out of a matrix, minors, and the adjoint matrix."""

from __future__ import annotations

from dataclasses import replace

from symbody.errors import WorksheetError
from symbody.symbolic import Expr, Matrix, number
from symbody.worksheet.builtins.arrays import array_of
from symbody.worksheet.builtins.row_echelon import rows_of
from symbody.worksheet.evaluation.session import Command, Session
from symbody.worksheet.values.numeric import as_integer
from symbody.worksheet.values.value import Array, Listed, Range, Value

__all__ = ["PACKAGES"]


def _without(array: Array, rows: set[int], columns: set[int]) -> Array:
    kept_rows = [i for i in range(array.rows) if i not in rows]
    kept_columns = [j for j in range(array.columns) if j not in columns]
    entries = [array.entries[i * array.columns + j] for i in kept_rows for j in kept_columns]
    return replace(
        array, rows=len(kept_rows), columns=len(kept_columns), entries=entries, attributes=(), frame=None
    )


def _places(where: str, index: Value, count: int) -> set[int]:
    """Return the places, from 0, that an index, a range or a list of them stands for."""
    if isinstance(index, Listed):
        return {place for each in index.items for place in _places(where, each, count)}
    ends = (index.start, index.stop) if isinstance(index, Range) else (index, index)
    low, high = (as_integer(each) for each in ends)
    if low is None or high is None:
        raise WorksheetError(f"{where}: expected an index, a range of them, or a list")
    low, high = (each + count + 1 if each < 0 else each for each in (low, high))
    if not 1 <= low <= high + 1 <= count + 1:
        raise WorksheetError(f"{where}: an index out of range; expected one from 1 to {count}")
    return set(range(low - 1, high))


def _deleted(name: str, *, rows: bool) -> Command:
    def command(session: Session, value: Value, index: Value) -> Value:
        array = array_of(session, value, name)
        places = _places(name, index, array.rows if rows else array.columns)
        return _without(array, places if rows else set(), set() if rows else places)

    return command


def _square(session: Session, value: Value, where: str) -> Array:
    array = array_of(session, value, where)
    if array.rows != array.columns:
        raise WorksheetError(f"{where}: a {array.rows}x{array.columns} matrix; expected a square one")
    return array


def _determinant(session: Session, array: Array) -> Expr:
    return Matrix(rows_of(session, array)).det() if array.entries else number(1)


def minor(session: Session, value: Value, i: Value, j: Value) -> Value:
    """Minor(A, i, j): the determinant of A without row i and column j."""
    array = _square(session, value, "Minor")
    places = (_places("Minor", each, array.rows) for each in (i, j))
    return _determinant(session, _without(array, *places))


def adjoint(session: Session, value: Value) -> Value:
    """Adjoint(A): the transposed matrix of cofactors, det(A) times the inverse."""
    array = _square(session, value, "Adjoint")
    n = array.rows
    entries: list[Value] = [
        (-1) ** (i + j) * _determinant(session, _without(array, {j}, {i})) for i in range(n) for j in range(n)
    ]
    return replace(array, entries=entries, attributes=(), frame=None)


PACKAGES: dict[str, dict[str, Command]] = {
    "LinearAlgebra": {
        "DeleteRow": _deleted("DeleteRow", rows=True),
        "DeleteColumn": _deleted("DeleteColumn", rows=False),
        "Minor": minor,
        "Adjoint": adjoint,
    },
    "linalg": {
        "delrows": _deleted("delrows", rows=True),
        "delcols": _deleted("delcols", rows=False),
        "adjoint": adjoint,
        "adj": adjoint,
        "minor": lambda session, value, i, j: _without(
            array := array_of(session, value, "minor"),
            _places("minor", i, array.rows),
            _places("minor", j, array.columns),
        ),
    },
}
