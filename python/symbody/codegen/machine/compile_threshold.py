"""The size from which a call is compiled; `lambdify` decides, and also considers linear systems and `compile=`."""

from __future__ import annotations

__all__ = ["is_worth_compiling"]

POINTS, FIXED = 2000, 200_000
"""Points for each operation that is compiled, and operations at points for what compiling takes at least.

Per operation, evaluating takes some 1.1 ns at each of many points, and compiling some 0.1 ms, plus 10 ms for any
function (inverse dynamics, mass matrix and forward dynamics of robots, 345 to 2450 operations). Both times grow as the
size, and compiling pays within some fifty calls of so many points; it would take thousands of calls at 20 points.
"""


def is_worth_compiling(operations: int, points: int) -> bool:
    """Return whether the size of a call is worth compiling it: ``points operations >= 2000 operations + 200 000``.

    Neither the clock nor earlier calls matter, so that equal calls give equal digits.

    >>> is_worth_compiling(10_000, 20), is_worth_compiling(10_000, 2020)
    (False, True)
    """
    return points * operations >= POINTS * operations + FIXED
