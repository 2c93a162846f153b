"""Shapes of matrices, which determine some of their entries: ``Matrix(3, shape = symmetric, ..)``."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from symbody.symbolic import Expr, number
from symbody.worksheet.evaluation.session import Session
from symbody.worksheet.values.value import Array, Listed, Value

__all__ = ["MIRRORED", "on_diagonal", "shaped"]

_ZERO = number(0)
_NEGATIVE = frozenset({"antisymmetric", "skewsymmetric"})
MIRRORED = frozenset({"symmetric"}) | _NEGATIVE

_HELD: dict[str, Callable[[int, int], bool]] = {
    "identity": lambda row, column: row == column,
    "diagonal": lambda row, column: row == column,
    "triangular[upper]": lambda row, column: row <= column,
    "triangular[lower]": lambda row, column: row >= column,
}
"""The entries that a shape contains; the others are zero."""


def on_diagonal(session: Session, content: Value, kind: str) -> Array | None:
    """Return a matrix with the items of a list or a vector on its diagonal; None for other content."""
    found = session.resolve(content)
    if isinstance(found, Array) and 1 in (found.rows, found.columns):
        items = [session.current(each) for each in found.entries]
    elif isinstance(found, Listed) and not any(
        isinstance(session.resolve(each), Listed) for each in found.items
    ):
        items = list(found.items)
    else:
        return None
    size = len(items)
    entries = [items[i] if i == j else _ZERO for i in range(size) for j in range(size)]
    return Array(size, size, entries, kind)


def shaped(array: Array, shape: str, fill: Value | None) -> Array:
    """Return a matrix with the entries of its shape: on the diagonal, 1 for identity and ``fill`` for diagonal."""
    entries = list(array.entries)
    held = _HELD.get(shape)
    diagonal = number(1) if shape == "identity" else fill if shape == "diagonal" else None
    for place, entry in enumerate(array.entries):
        row, column = divmod(place, array.columns)
        mirrored = column * array.columns + row
        if held is not None and not held(row, column):
            entries[place] = _ZERO
        elif diagonal is not None and row == column:
            entries[place] = diagonal
        elif shape in MIRRORED and _is_empty(entry) and column < array.rows and row < array.columns:
            entries[place] = _opposite(array.entries[mirrored], shape)
    mirrored = (-1 if shape in _NEGATIVE else 1) if shape in MIRRORED else 0
    return replace(array, entries=entries, mirrored=mirrored)


def _opposite(entry: Value, shape: str) -> Value:
    return -entry if shape in _NEGATIVE and isinstance(entry, Expr) else entry


def _is_empty(value: Value) -> bool:
    """Whether an entry is zero, or an entry of an old-style array that has no value."""
    return isinstance(value, Expr) and (
        value == _ZERO or (value.kind == "symbol" and value.name.startswith("?["))
    )
