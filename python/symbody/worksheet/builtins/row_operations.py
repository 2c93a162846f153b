"""Elementary operations on rows and columns: of linalg by commands of their own, of LinearAlgebra by one each."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from symbody.errors import WorksheetError
from symbody.symbolic import number
from symbody.worksheet.builtins.arrays import array_of
from symbody.worksheet.evaluation.arithmetic import binary, transposed
from symbody.worksheet.evaluation.condition import truth
from symbody.worksheet.evaluation.session import Command, Session
from symbody.worksheet.values.numeric import as_integer
from symbody.worksheet.values.value import Array, Listed, Reference, Relation, Value

__all__ = ["PACKAGES"]

_MINUS = number(-1)

_Rows = list[list[Value]]


def _rows(array: Array) -> _Rows:
    return [array.entries[i * array.columns : (i + 1) * array.columns] for i in range(array.rows)]


def _place(where: str, index: Value, count: int) -> int:
    """Return the place, from 0, of a row or a column."""
    place = as_integer(index)
    if place is None or not 1 <= abs(place) <= count:
        raise WorksheetError(f"{where}: expected an index from 1 to {count}")
    return place - 1 if place > 0 else place + count


def _added(session: Session, rows: _Rows, changed: int, other: int, factor: Value) -> None:
    """Add a multiple of another row to a row.

    Args:
        session: the session.
        rows: all rows, of which one changes.
        changed: the place of that one.
        other: the place of the other row.
        factor: what this is multiplied by.
    """
    rows[changed] = [
        binary(session, "+", a, binary(session, "*", factor, b))
        for a, b in zip(rows[changed], rows[other], strict=True)
    ]


def _exchanged(rows: _Rows, one: int, other: int) -> None:
    rows[one], rows[other] = rows[other], rows[one]


def _multiplied(session: Session, rows: _Rows, changed: int, factor: Value) -> None:
    rows[changed] = [binary(session, "*", factor, each) for each in rows[changed]]


def _with_rows(array: Array, rows: _Rows) -> Array:
    return replace(
        array, entries=[each for row in rows for each in row], attributes=(), frame=None, mirrored=0
    )


def _turned(array: Array, *, columns: bool) -> Array:
    """Return a matrix whose rows are the columns of another one, for operations on columns."""
    return transposed(array) if columns else array


def _old(name: str, count: int, *, columns: bool = False) -> Command:
    """Return a command of linalg, of so many places and, but for an exchange, a factor."""
    verb = name[:3]

    def command(session: Session, value: Value, *arguments: Value) -> Value:
        if len(arguments) != count + (verb != "swa"):
            raise WorksheetError(
                f"{name}: {1 + len(arguments)} arguments; expected {1 + count + (verb != 'swa')}"
            )
        array = _turned(array_of(session, value, name), columns=columns)
        rows = _rows(array)
        places = [_place(name, each, array.rows) for each in arguments[:count]]
        if verb == "add":  # addrow(A, r1, r2, m): row r2 becomes m*r1 + r2
            _added(session, rows, places[1], places[0], arguments[2])
        elif verb == "mul":
            _multiplied(session, rows, places[0], arguments[1])
        else:
            _exchanged(rows, *places)
        return _turned(_with_rows(array, rows), columns=columns)

    return command


def _new(name: str, *, columns: bool) -> Command:
    """Return RowOperation or ColumnOperation."""

    def command(session: Session, value: Value, places: Value, *arguments: Value) -> Value:
        options = [each for each in arguments if isinstance(each, Relation)]
        factors = [each for each in arguments if not isinstance(each, Relation)]
        array = _turned(array_of(session, value, name), columns=columns)
        rows = _rows(array)
        listed = places.items if isinstance(places, Listed) else (places,)
        at = [_place(name, each, array.rows) for each in listed]
        if len(at) == 1 and factors:
            _multiplied(session, rows, at[0], factors[0])
        elif len(at) == 2 and factors:  # RowOperation(A, [i, j], s): row i becomes i + s*j
            _added(session, rows, at[0], at[1], factors[0])
        elif len(at) == 2:
            _exchanged(rows, *at)
        else:
            raise WorksheetError(f"{name}: expected (A, i, factor), (A, [i, j]) or (A, [i, j], factor)")
        made = _turned(_with_rows(array, rows), columns=columns)
        return _in_place(session, value, made) if _is_in_place(session, options) else made

    return command


def _is_in_place(session: Session, options: Sequence[Relation]) -> bool:
    return any(session.text(each.left) == "inplace" and truth(session, each.right) for each in options)


def _in_place(session: Session, value: Value, made: Array) -> Value:
    """Put the entries of a result into the matrix itself."""
    held = session.resolve(value)
    if isinstance(held, Array):
        held.entries, held.frame, held.attributes = list(made.entries), None, ()
    if isinstance(value, Reference):
        session.touch(value.name)
    return value


def pivot(session: Session, value: Value, i: Value, j: Value) -> Value:
    """pivot(A, i, j): multiples of row i are added to the other rows, so that their entries of column j are 0."""
    array = array_of(session, value, "pivot")
    rows = _rows(array)
    row, column = _place("pivot", i, array.rows), _place("pivot", j, array.columns)
    if getattr(rows[row][column], "is_zero", False):
        raise WorksheetError(f"pivot: the entry ({row + 1}, {column + 1}) is zero; expected another place")
    for k in range(array.rows):
        if k != row:
            ratio = binary(session, "/", rows[k][column], rows[row][column])
            _added(session, rows, k, row, binary(session, "*", _MINUS, ratio))
    return _with_rows(array, rows)


PACKAGES: dict[str, dict[str, Command]] = {
    "LinearAlgebra": {
        "RowOperation": _new("RowOperation", columns=False),
        "ColumnOperation": _new("ColumnOperation", columns=True),
        "Pivot": pivot,
    },
    "linalg": {
        "addrow": _old("addrow", 2),
        "mulrow": _old("mulrow", 1),
        "swaprow": _old("swaprow", 2),
        "addcol": _old("addcol", 2, columns=True),
        "mulcol": _old("mulcol", 1, columns=True),
        "swapcol": _old("swapcol", 2, columns=True),
        "pivot": pivot,
    },
}
