"""Linear equations in symbols: any number of them, unknowns may stay free."""

from __future__ import annotations

from symbody.errors import ExpressionError
from symbody.symbolic import Expr, cost, jacobian, number, simplify, solve

__all__ = ["solve_linear"]


def solve_linear(residuals: list[Expr], unknowns: list[Expr]) -> dict[Expr, Expr] | None:
    """Return the values of unknowns, free ones by themselves; None where equations are not linear or contradict."""
    residuals = [each for each in residuals if not each.is_zero]
    if not residuals:
        return {each: each for each in unknowns}
    if len(residuals) == len(unknowns) <= 6:
        try:
            return dict(solve(residuals, unknowns))
        except ExpressionError:
            pass
    return _eliminated(residuals, unknowns)


def _eliminated(residuals: list[Expr], unknowns: list[Expr]) -> dict[Expr, Expr] | None:
    """Gauss-Jordan elimination; the pivot of a column is the cheapest entry that isn't zero."""
    matrix = jacobian(residuals, unknowns)
    rows = [[matrix[i, j] for j in range(len(unknowns))] for i in range(len(residuals))]
    if any(entry.free_symbols & set(unknowns) for row in rows for entry in row):
        return None
    zero = dict.fromkeys(unknowns, number(0))
    right = [-each.subs(zero) for each in residuals]
    pivots: dict[int, int] = {}
    free_rows = set(range(len(rows)))
    for _ in range(min(len(rows), len(unknowns))):
        choice = _pivot(rows, free_rows, set(range(len(unknowns))) - pivots.keys())
        if choice is None:
            break
        row, column = choice
        pivots[column] = row
        free_rows.remove(row)
        _clear(rows, right, row, column)
    if any(not right[row].is_zero for row in free_rows):
        return None
    free = [j for j in range(len(unknowns)) if j not in pivots]
    solution: dict[Expr, Expr] = {}
    for j, unknown in enumerate(unknowns):
        if j in pivots:
            rest = sum((rows[pivots[j]][k] * unknowns[k] for k in free), start=number(0))
            solution[unknown] = simplify(right[pivots[j]] - rest)
        else:
            solution[unknown] = unknown
    return solution


def _pivot(rows: list[list[Expr]], free: set[int], columns: set[int]) -> tuple[int, int] | None:
    candidates = [
        (not rows[i][j].is_number, sum(not rows[i][k].is_zero for k in columns), cost(rows[i][j]).total, j, i)
        for j in columns
        for i in free
        if not rows[i][j].is_zero
    ]
    if not candidates:
        return None
    *_, column, row = min(candidates)
    return row, column


def _clear(rows: list[list[Expr]], right: list[Expr], row: int, column: int) -> None:
    pivot = rows[row][column]
    rows[row] = [entry / pivot for entry in rows[row]]
    right[row] = right[row] / pivot
    for i, other in enumerate(rows):
        factor = other[column]
        if i != row and not factor.is_zero:
            rows[i] = [entry - factor * own for entry, own in zip(other, rows[row], strict=True)]
            right[i] = right[i] - factor * right[row]
