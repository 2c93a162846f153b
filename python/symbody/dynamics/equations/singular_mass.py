"""Mass matrices without a pivot: which speeds move no mass, in the user's names."""

from __future__ import annotations

from collections.abc import Sequence

from symbody.symbolic import Expr, Matrix

__all__ = ["described_singularity"]


def described_singularity(M: Matrix, speeds: Sequence[Expr]) -> str:
    """Return which speeds move no mass, and the way out; the empty text if the matrix is regular almost everywhere.

    A speed is in a direction of the null space if the matrix keeps its rank without the column of that speed.

    >>> from symbody import functions_of_time
    >>> described_singularity(Matrix([[1, 1], [1, 1]]), functions_of_time("u v"))
    'the mass matrix is singular: a combination of u, v moves no mass; give it some, or leave a coordinate out'
    """
    rank = M.rank()
    if rank == M.rows:
        return ""
    columns = [M.T.row(k) for k in range(M.columns)]
    massless = [
        u for u, column in zip(speeds, columns, strict=True) if all(entry.is_zero for entry in column)
    ]
    others = [u for k, u in enumerate(speeds) if u not in massless and _rank_without(columns, k) == rank]
    return f"the mass matrix is singular: {_moving_no_mass(massless, others)}"


def _rank_without(columns: Sequence[Sequence[Expr]], left_out: int) -> int:
    return Matrix([column for k, column in enumerate(columns) if k != left_out]).rank()


def _moving_no_mass(massless: Sequence[Expr], others: Sequence[Expr]) -> str:
    names = ", ".join(map(str, [*massless, *others]))
    if others:
        return f"a combination of {names} moves no mass; give it some, or leave a coordinate out"
    if len(massless) == 1:
        return f"{names} moves no mass; give it some, or leave that coordinate out"
    return f"{names} move no mass; give them some, or leave those coordinates out"
