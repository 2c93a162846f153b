"""Equations that are too long to be read, by their sizes."""

from __future__ import annotations

from collections.abc import Sequence

from symbody.multibody import System
from symbody.symbolic import Expr, cost
from symbody.symbolic.given.arguments import counted

READABLE = 4000
"""Operations up to which equations are written out."""
_SHOWN = 4
"""The first and the last equations, so many each, whose sizes are listed."""


def is_readable(residuals: Sequence[Expr]) -> bool:
    """Return whether equations are short enough to be written out."""
    return cost(residuals).total <= READABLE


def summary(system: System, residuals: Sequence[Expr]) -> str:
    """Return the number and the sizes of equations, and how to see one of them."""
    n = len(residuals)
    shown = [k for k in range(n) if k < _SHOWN or k >= n - _SHOWN]
    sizes = [f"{system.driving[k]}: {counted(cost(residuals[k]).total, 'operation')}" for k in shown]
    if len(shown) < n:
        sizes.insert(_SHOWN, "...")
    return "\n    ".join(
        [
            (
                f"EQUATIONS OF MOTION of {counted(n, 'speed')}, {counted(len(system.constraints), 'constraint')}: "
                f"{counted(cost(residuals).total, 'operation')} in all"
            ),
            *sizes,
            "Too long to be read at once. One of them: readable(equations.residuals[0]);",
            "one entry of the mass matrix: readable(equations.mass_matrix[0, 0]).",
        ]
    )
