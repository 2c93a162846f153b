"""Formulas of sections: equations below each other, if they are short enough to be read."""

from __future__ import annotations

from collections.abc import Sequence

from symbody.document.document import Block, Formula, Math, Prose, Words, prose
from symbody.dynamics.display.row import printed
from symbody.multibody import Variables
from symbody.symbolic import Expr, cost, latex, listing
from symbody.symbolic.expression.latex_layout import LINE, aligned, broken, width
from symbody.symbolic.given.arguments import counted

READABLE = 6000
"""The letters of LaTeX up to which the formulas of a section are printed: about a page."""

WIDEST = 3 * LINE
"""The width of the longest row: two lines of a page, as both parts of a fraction count."""


def listed(expressions: Sequence[Expr]) -> Words:
    """Return expressions with commas between them."""
    words: list[str | Math] = []
    for expression in expressions:
        words += [", ", Math(latex(expression))]
    return tuple(words[1:])


def equalities(
    lead: Prose, names: Sequence[str], values: Sequence[Expr], system: Variables | None = None
) -> list[Block]:
    r"""Return equations below each other, after their common parts; or the number of operations if they are too long.

    Args:
        lead: the beginning of the sentence that the formulas end.
        names: the left sides, in LaTeX.
        values: the right sides.
        system: gives the order of coordinates and speeds in products, as in the equations of motion.

    >>> from symbody import symbols
    >>> _, formula = equalities(prose("The height is"), ["y"], [symbols("x") ** 2])
    >>> print(formula.latex)
    \begin{aligned} y &= x^{2} \end{aligned}
    """
    definitions, texts = listing(values, "latex") if system is None else printed(values, "latex", system)
    pairs = [*definitions, *zip(names, texts, strict=True)]
    rows = [row for left, right in pairs for row in broken(f"{left} &= ", right)]
    if sum(map(len, rows)) > READABLE or max(map(width, rows), default=0) > WIDEST:
        operations = counted(cost(list(values)).total, "operation")
        return [prose(*lead.words, f" expressions of {operations}, too long to be read here.")]
    return [lead, Formula(aligned(rows))]
