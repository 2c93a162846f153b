"""Ignorable coordinates of linear equations: those on which nothing else depends."""

from __future__ import annotations

from symbody.symbolic import Matrix

__all__ = ["ignorable_places"]


def ignorable_places(rows: Matrix, outputs: Matrix, count: int) -> tuple[int, ...]:
    """Return the places of coordinates on which neither other equations nor outputs depend.

    A coordinate on which only ignorable ones depend is ignorable, too: the place of a wheel depends on its heading.

    Args:
        rows: the rates, a row per state; those of coordinates come first, in rows and in columns.
        outputs: the coefficients of the outputs.
        count: the number of coordinates.
    """
    supports = [
        {i for i in range(rows.rows) if not rows[i, k].is_zero}
        | {rows.rows for i in range(outputs.rows) if not outputs[i, k].is_zero}
        for k in range(count)
    ]
    found: set[int] = set()
    while True:
        more = {k for k in range(count) if supports[k] <= found} - found
        if not more:
            return tuple(sorted(found))
        found |= more
