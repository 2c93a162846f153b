"""Equations that are too long to be read, by their sizes."""

from __future__ import annotations

from collections.abc import Sequence

from symbody.multibody import Variables
from symbody.symbolic import Expr, cost, latex
from symbody.symbolic.expression.html_table import html_table
from symbody.symbolic.expression.latex_layout import aligned
from symbody.symbolic.expression.text_layout import ends
from symbody.symbolic.given.arguments import counted

READABLE = 1000
"""Operations up to which equations are written out."""


def is_readable(residuals: Sequence[Expr]) -> bool:
    """Return whether equations are short enough to be written out."""
    return cost(residuals).total <= READABLE


def summary(system: Variables, residuals: Sequence[Expr]) -> str:
    """Return the number and the sizes of equations, and how to see one of them."""
    sizes = [
        "..." if size is None else f"{size[0]}: {counted(size[1], 'operation')}"
        for size in sizes_by_speed(system, residuals)
    ]
    return "\n    ".join([f"EQUATIONS OF MOTION of {total(system, residuals)}", *sizes, *_ADVICE])


def summary_in_latex(system: Variables, residuals: Sequence[Expr]) -> str:
    """Return the number and the sizes of equations in LaTeX."""
    sizes = [
        r"&\;\vdots"
        if size is None
        else rf"{latex(size[0])} &\colon \text{{{counted(size[1], 'operation')}}}"
        for size in sizes_by_speed(system, residuals)
    ]
    return aligned([rf"&\text{{Equations of motion of {total(system, residuals)}}}", *sizes])


def summary_table(system: Variables, residuals: Sequence[Expr]) -> str:
    """Return the number and the sizes of equations for a notebook, in HTML."""
    rows = [("...", "...") if size is None else size for size in sizes_by_speed(system, residuals)]
    title = f"Equations of motion of {total(system, residuals)}"
    return html_table(title, ["equation of", "operations"], rows, " ".join(_ADVICE))


_ADVICE = (
    "Too long to be read at once. One of them: show(equations.equation_of(q)) for a coordinate or speed q;",
    "one entry of the mass matrix: readable(equations.mass_matrix[0, 0]).",
)


def total(system: Variables, residuals: Sequence[Expr]) -> str:
    """Return the numbers of equations, constraints and operations in words."""
    sizes = f"{counted(len(residuals), 'speed')}, {counted(len(system.constraints), 'constraint')}"
    return f"{sizes}: {counted(cost(residuals).total, 'operation')} in all"


def sizes_by_speed(system: Variables, residuals: Sequence[Expr]) -> list[tuple[Expr, int] | None]:
    """Return the operations of the first and the last equations by their speeds; None stands for those between."""
    places = ends(range(len(residuals)))
    return [None if k is None else (system.driving[k], cost(residuals[k]).total) for k in places]
