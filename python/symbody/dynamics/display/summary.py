"""Equations that are too long to be read, by their sizes."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from symbody.multibody import System
from symbody.symbolic import Expr, cost, latex
from symbody.symbolic.expression.latex_layout import aligned
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
    sizes = [f"{name}: {size}" if size else name for name, size in _sizes(system, residuals, str)]
    hint = [
        "Too long to be read at once. One of them: readable(equations.residuals[0]);",
        "one entry of the mass matrix: readable(equations.mass_matrix[0, 0]).",
    ]
    return "\n    ".join([f"EQUATIONS OF MOTION of {_total(system, residuals)}", *sizes, *hint])


def summary_in_latex(system: System, residuals: Sequence[Expr]) -> str:
    """Return the number and the sizes of equations in LaTeX."""
    sizes = [
        rf"{name} &\colon \text{{{size}}}" if size else r"&\;\vdots"
        for name, size in _sizes(system, residuals, latex)
    ]
    return aligned([rf"&\text{{Equations of motion of {_total(system, residuals)}}}", *sizes])


def _total(system: System, residuals: Sequence[Expr]) -> str:
    return (
        f"{counted(len(residuals), 'speed')}, {counted(len(system.constraints), 'constraint')}: "
        f"{counted(cost(residuals).total, 'operation')} in all"
    )


def _sizes(system: System, residuals: Sequence[Expr], name: Callable[[Expr], str]) -> list[tuple[str, str]]:
    """Return the names and the sizes of the first and the last equations, and dots for those between."""
    n = len(residuals)
    shown = [k for k in range(n) if k < _SHOWN or k >= n - _SHOWN]
    sizes = [(name(system.driving[k]), counted(cost(residuals[k]).total, "operation")) for k in shown]
    if len(shown) < n:
        sizes.insert(_SHOWN, ("...", ""))
    return sizes
