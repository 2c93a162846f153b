"""Which unknowns of linear conditions depend on the others: pivots that are neither zero nor small."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from contextlib import suppress
from functools import partial
from typing import TYPE_CHECKING, Any, NamedTuple, TypeAlias

from symbody.deferred import Deferred
from symbody.errors import ExpressionError
from symbody.symbolic import (
    Dependence,
    Expr,
    Matrix,
    derivation,
    free_symbols,
    linear_solve,
    substitute,
    symbols,
)
from symbody.symbolic.numeric.tape import Tape

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray
else:
    np = Deferred("numpy")


__all__ = ["Pivots", "dependent_columns", "solved"]

Array: TypeAlias = "NDArray[np.float64]"

_LEAST = 1e-9
"""The size, relative to the largest entry of a row, below which an entry is rounding."""
_THRESHOLD = 0.1
"""The size, relative to the largest candidate, from which an entry may be a pivot [Duff, Erisman & Reid 1986, 5.4]."""


class Pivots(NamedTuple):
    """The places of independent rows of a matrix, and of as many columns in which they are regular."""

    rows: tuple[int, ...]
    columns: tuple[int, ...]


def dependent_columns(A: Matrix, allowed: Sequence[int], rank: Callable[[int, int], Any]) -> Pivots:
    """Return independent rows, and the columns of the unknowns that they determine.

    Gaussian elimination at one place, at which all parameters have different values near 1: a pivot that isn't small
    there vanishes for special parameters alone. Among the entries that are not small, the rank decides.

    Args:
        A: the matrix, m x n.
        allowed: the columns that may be chosen.
        rank: what puts the entries of a row in order, by row and column; the first one is taken.
    """
    values = _sample(A)
    scale = np.abs(values).max(axis=1, initial=0.0)
    rows, columns = list[int](), list[int]()
    for i in range(A.rows):
        row = values[i]
        for k, column in zip(rows, columns, strict=True):
            row -= row[column] / values[k, column] * values[k]
        left = [j for j in allowed if j not in columns and abs(row[j]) > _LEAST * scale[i]]
        if left:
            largest = max(abs(row[j]) for j in left)
            rows.append(i)
            columns.append(
                min((j for j in left if abs(row[j]) >= _THRESHOLD * largest), key=partial(rank, i))
            )
    return Pivots(tuple(rows), tuple(columns))


def _sample(A: Matrix) -> Array:
    """Return the matrix at values of its variables that have nothing to do with each other."""
    entries = A.entries
    leaves = sorted(
        free_symbols(entries), key=lambda leaf: (str(leaf), leaf.order if _is_function(leaf) else 0)
    )
    named = dict(zip(leaves, (symbols(f"sample_{k}") for k in range(len(leaves))), strict=True))
    values = [0.6 + (k + 1) * 0.6180339887498949 % 1 for k in range(len(leaves))]
    with derivation(fresh=True):
        tape = Tape([*named.values()], substitute(entries, named))
    found = np.array(tape.evaluate(values), dtype=np.float64).reshape(A.shape)
    return np.nan_to_num(found, nan=1.0, posinf=1.0, neginf=1.0)


def _is_function(leaf: Expr) -> bool:
    return leaf.kind == "time_function"


def solved(A: Matrix, pivots: Pivots, right: Matrix) -> Matrix:
    """Return X with ``A[rows, columns] X = right[rows]``: written out block by block, or solved at run time."""
    square = Matrix.from_entries(
        len(pivots.rows), len(pivots.columns), [A[i, j] for i in pivots.rows for j in pivots.columns]
    )
    sides = [[right[i, k] for i in pivots.rows] for k in range(right.columns)]
    if not pivots.rows:
        return Matrix.from_entries(0, right.columns, ())
    found: list[Sequence[Expr]] = []
    with suppress(ExpressionError):
        dependence = Dependence(square)
        found = [dependence.completed({}, side) for side in sides]
    if len(found) < len(sides):
        found = [side if _is_zero(side) else linear_solve(square, side) for side in sides]
    return Matrix.from_entries(
        len(pivots.columns),
        right.columns,
        [column[i] for i in range(len(pivots.columns)) for column in found],
    )


def _is_zero(entries: Sequence[Expr]) -> bool:
    return all(entry.is_zero for entry in entries)
