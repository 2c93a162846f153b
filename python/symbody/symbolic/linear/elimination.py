"""Gaussian elimination in symbols, of any number of unknowns, some of which may stay free."""

from __future__ import annotations

from collections.abc import Sequence

from symbody.symbolic._core import Expr
from symbody.symbolic.calculus.derivative import jacobian, substitute
from symbody.symbolic.expression.leaves import number

__all__ = ["eliminated", "is_linear"]


def is_linear(equations: Sequence[Expr], unknowns: Sequence[Expr]) -> bool:
    """Return whether expressions are linear in unknowns together.

    >>> from symbody.symbolic import symbols
    >>> x, y = symbols("x y")
    >>> is_linear([x + y], [x, y]), is_linear([x * y], [x, y])
    (True, False)
    """
    slopes = jacobian(list(equations), list(unknowns)).entries
    held = [each for each in slopes if each.free_symbols & {*unknowns}]
    return not held or all(each.is_zero for each in jacobian(held, list(unknowns)).entries)


def eliminated(equations: Sequence[Expr], unknowns: Sequence[Expr]) -> dict[Expr, Expr] | None:
    """Return the solution of linear equations: unknowns by those that stay free; None if they contradict each other.

    The pivots are those with the fewest other entries in their row and column [Markowitz 1957].

    >>> from symbody.symbolic import symbols
    >>> x, y, z, a = symbols("x y z a")
    >>> eliminated([x + y - a, x - y - z], [x, y, z])
    {x: a - y, z: a - 2*y}
    >>> eliminated([x - 1, x - 2], [x]) is None
    True
    """
    columns = list(unknowns)
    at_zero = dict.fromkeys(columns, number(0))
    slopes = jacobian(list(equations), columns)
    rows = [
        {
            k: entry
            for k in range(len(columns))
            if not (entry := substitute((slopes[i, k],), at_zero)[0]).is_zero
        }
        for i in range(len(equations))
    ]
    right = [-each for each in substitute(tuple(equations), at_zero)]
    order: list[tuple[int, int]] = []
    left = {*range(len(rows))}
    while pivot := _pivot(rows, left):
        i, k = pivot
        left.remove(i)
        order.append(pivot)
        for j in [j for j in left if k in rows[j]]:
            factor = rows[j].pop(k) / rows[i][k]
            for column, entry in rows[i].items():
                if column != k:
                    _add(rows[j], column, -factor * entry)
            right[j] -= factor * right[i]
    if any(not right[i].is_zero for i in left):
        return None
    return _back(rows, right, order, columns)


def _pivot(rows: Sequence[dict[int, Expr]], left: set[int]) -> tuple[int, int] | None:
    """Return the position of the next pivot: the one with the least fill-in, numbers first.

    An entry that may be zero, such as ``cos(q)``, is a pivot only if no other entry is left.
    """
    count: dict[int, int] = {}
    for i in left:
        for k in rows[i]:
            count[k] = count.get(k, 0) + 1
    places = [
        (_may_be_zero(entry), (len(rows[i]) - 1) * (count[k] - 1), not entry.is_number, k, i)
        for i in sorted(left)
        for k, entry in rows[i].items()
    ]
    if not places:
        return None
    *_, k, i = min(places)
    return i, k


def _may_be_zero(entry: Expr) -> bool:
    """Whether an entry can be zero at special values: anything but products and powers of symbols."""
    if entry.kind == "product":
        return any(_may_be_zero(factor) for factor in entry.args)
    if entry.kind == "power":
        return _may_be_zero(entry.args[0])
    return not (entry.is_number or entry.kind == "symbol")


def _add(row: dict[int, Expr], k: int, term: Expr) -> None:
    total = row[k] + term if k in row else term
    if total.is_zero:
        row.pop(k, None)
    else:
        row[k] = total


def _back(
    rows: Sequence[dict[int, Expr]],
    right: Sequence[Expr],
    order: Sequence[tuple[int, int]],
    columns: Sequence[Expr],
) -> dict[Expr, Expr]:
    """Return the unknowns by back substitution."""
    solved: dict[int, Expr] = {}
    for i, k in reversed(order):
        total = right[i]
        for column, entry in rows[i].items():
            if column != k:
                total -= entry * solved.get(column, columns[column])
        solved[k] = total / rows[i][k]
    return {columns[k]: value for k, value in solved.items()}
