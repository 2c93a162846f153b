"""Row echelon forms, by value, and what follows: null spaces, bases, solutions with free unknowns."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from symbody.errors import WorksheetError
from symbody.symbolic import Expr, number, simplify
from symbody.worksheet.builtins.arrays import array_of
from symbody.worksheet.evaluation.arithmetic import scalar
from symbody.worksheet.evaluation.current import set_of
from symbody.worksheet.evaluation.entrywise import parts_of
from symbody.worksheet.evaluation.session import Command, Session
from symbody.worksheet.values.naming import symbol
from symbody.worksheet.values.value import Array, Listed, MapleSet, Value

__all__ = ["PACKAGES", "null_vectors", "rows_of", "solved"]

Rows = list[list[Expr]]


def rows_of(session: Session, array: Array) -> Rows:
    """Return the entries of a matrix by rows, with what was assigned since."""
    entries = [scalar(session, session.current(each)) for each in array.entries]
    return [entries[i * array.columns : (i + 1) * array.columns] for i in range(array.rows)]


def _echelon(rows: Rows, columns: int, *, reduced: bool) -> tuple[Rows, list[int]]:
    """Return the echelon form and its pivot columns; reduced, with pivots 1 and zeros above them."""
    rows, pivots = [list(row) for row in rows], list[int]()
    for j in range(columns):
        top = len(pivots)
        pivot = next((i for i in range(top, len(rows)) if not rows[i][j].is_zero), None)
        if pivot is None:
            continue
        rows[top], rows[pivot] = rows[pivot], rows[top]
        if reduced:
            rows[top] = [simplify(each / rows[top][j]) for each in rows[top]]
        for i in range(0 if reduced else top + 1, len(rows)):
            if i != top and not rows[i][j].is_zero:
                factor = rows[i][j] / rows[top][j]
                rows[i] = [simplify(a - factor * b) for a, b in zip(rows[i], rows[top], strict=True)]
        pivots.append(j)
    return rows, pivots


def _form(*, reduced: bool) -> Command:
    def command(session: Session, value: Value, *options: Value) -> Value:
        array = array_of(session, value, "ReducedRowEchelonForm" if reduced else "GaussianElimination")
        rows, _ = _echelon(rows_of(session, array), array.columns, reduced=reduced)
        return replace(array, entries=[each for row in rows for each in row], attributes=(), frame=None)

    return command


def null_vectors(session: Session, array: Array) -> list[list[Expr]]:
    """Return a basis of the vectors v with A v = 0."""
    rows, pivots = _echelon(rows_of(session, array), array.columns, reduced=True)
    found: list[list[Expr]] = []
    for free in (j for j in range(array.columns) if j not in pivots):
        entries = [number(int(j == free)) for j in range(array.columns)]
        for i, j in enumerate(pivots):
            entries[j] = -rows[i][free]
        found.append(entries)
    return found


def _null_vectors(session: Session, value: Value, kind: str) -> list[Value]:
    array = array_of(session, value, "NullSpace")
    return [Array(array.columns, 1, [*each], kind) for each in null_vectors(session, array)]


def null_space(session: Session, value: Value, *options: Value) -> Value:
    """NullSpace(A): a set of vectors v with A v = 0 of which all others are made."""
    return MapleSet(tuple(_null_vectors(session, value, "Vector")))


def old_kernel(session: Session, value: Value, *options: Value) -> Value:
    """kernel(A), nullspace(A): a set of vectors v with A v = 0 of which all others are made."""
    return set_of(_null_vectors(session, value, "vector"))


def basis(session: Session, vectors: Value) -> Value:
    """Basis([v, w, ..]): those vectors of a list or set that don't depend on the ones before them."""
    found = session.resolve(vectors)
    items = parts_of(found)
    columns = [[scalar(session, each) for each in array_of(session, item, "Basis").entries] for item in items]
    rows = [list(row) for row in zip(*columns, strict=True)]
    _, pivots = _echelon(rows, len(items), reduced=False)
    kept = tuple(items[j] for j in pivots)
    return MapleSet(kept) if isinstance(found, MapleSet) else Listed(kept)


def solved(session: Session, array: Array, right: Array | None, where: str) -> Array:
    """Return the solution of linear equations, with free unknowns ``_t[1]``, .. where the matrix leaves some.

    Args:
        session: the session.
        array: the matrix; without right sides, its last column holds them.
        right: the right sides, one or several columns.
        where: the command, for messages.
    """
    rows = rows_of(session, array)
    sides = [row[-1:] for row in rows] if right is None else rows_of(session, right)
    matrix = [row[:-1] for row in rows] if right is None else rows
    if len(sides) != len(matrix):
        raise WorksheetError(
            f"{where}: {len(matrix)} equations and {len(sides)} right sides; expected as many"
        )
    columns = len(matrix[0])
    whole, pivots = _echelon([a + b for a, b in zip(matrix, sides, strict=True)], columns, reduced=True)
    if any(not each.is_zero for row in whole[len(pivots) :] for each in row[columns:]):
        raise WorksheetError(f"{where}: inconsistent system: the equations contradict each other")
    free = {j: symbol(f"_t[{k}]") for k, j in enumerate((j for j in range(columns) if j not in pivots), 1)}
    if free and len(sides[0]) > 1:
        raise WorksheetError(f"{where}: the matrix is singular; expected one right side, or another matrix")
    values = [_values(whole, pivots, free, columns, k) for k in range(len(sides[0]))]
    entries: list[Value] = [column[j] for j in range(columns) for column in values]
    kind = (right.kind if right is not None else "Vector") if len(values) == 1 else array.kind
    return Array(columns, len(values), entries, kind)


def _values(
    rows: Sequence[Sequence[Expr]], pivots: list[int], free: dict[int, Expr], columns: int, side: int
) -> list[Expr]:
    """Return the unknowns of a system in row echelon form.

    Args:
        rows: the rows, with their right sides behind the unknowns.
        pivots: the columns of the pivots, one for each row.
        free: the names of the unknowns without a pivot, by column.
        columns: the number of unknowns.
        side: which of the right sides.
    """
    found = [free.get(j, number(0)) for j in range(columns)]
    for i, j in enumerate(pivots):
        known = sum((rows[i][k] * name for k, name in free.items()), start=number(0))
        found[j] = rows[i][columns + side] - known
    return found


PACKAGES: dict[str, dict[str, Command]] = {
    "LinearAlgebra": {
        "GaussianElimination": _form(reduced=False),
        "ReducedRowEchelonForm": _form(reduced=True),
        "NullSpace": null_space,
        "Basis": basis,
    },
    "linalg": {
        "gausselim": _form(reduced=False),
        "gaussjord": _form(reduced=True),
        "rref": _form(reduced=True),
        "kernel": old_kernel,
        "nullspace": old_kernel,
        "basis": basis,
    },
}
