"""Equations that are too long to be read, by their sizes."""

from __future__ import annotations

from collections.abc import Sequence

from symbody.multibody import System
from symbody.symbolic import Expr, cost
from symbody.symbolic.expression.html_table import html_table
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
    sizes = [
        f"{speed}: {counted(size, 'operation')}" if size else "..."
        for speed, size in _sizes(system, residuals)
    ]
    return "\n    ".join([f"EQUATIONS OF MOTION of {_whole(system, residuals)}", *sizes, *_ADVICE])


def summary_table(system: System, residuals: Sequence[Expr]) -> str:
    """Return the same for a notebook, in HTML."""
    rows = [(speed, size or "...") for speed, size in _sizes(system, residuals)]
    title = f"Equations of motion of {_whole(system, residuals)}"
    return html_table(title, ["equation of", "operations"], rows, " ".join(_ADVICE))


_ADVICE = (
    "Too long to be read at once. One of them: readable(equations.residuals[0]);",
    "one entry of the mass matrix: readable(equations.mass_matrix[0, 0]).",
)


def _sizes(system: System, residuals: Sequence[Expr]) -> list[tuple[str, int]]:
    """Return the operations of the first and the last equations by their speeds; 0 stands for those between."""
    n = len(residuals)
    shown = [k for k in range(n) if k < _SHOWN or k >= n - _SHOWN]
    sizes = [(str(system.driving[k]), cost(residuals[k]).total) for k in shown]
    return sizes if len(shown) == n else [*sizes[:_SHOWN], ("...", 0), *sizes[_SHOWN:]]


def _whole(system: System, residuals: Sequence[Expr]) -> str:
    sizes = f"{counted(len(residuals), 'speed')}, {counted(len(system.constraints), 'constraint')}"
    return f"{sizes}: {counted(cost(residuals).total, 'operation')} in all"
