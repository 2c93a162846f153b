"""The equations of motion, as `Equations.latex` prints them; of long ones, the sizes and what can be read."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from symbody.document.document import Block, Formula, Heading, Math, Table, Words, prose
from symbody.document.formula import equalities
from symbody.document.subject import Subject
from symbody.dynamics.display.summary import sizes_by_speed
from symbody.symbolic import Expr, cost, latex
from symbody.symbolic.expression.latex_layout import LINE, one_formula, width
from symbody.symbolic.given.arguments import counted

ROWS = 180
"""The rows up to which equations are printed: three pages, of which each row is short."""

MATRIX = 12
"""The rows up to which the mass matrix is described entry by entry: so many columns fit a page."""

SHORT = 20
"""The operations up to which an entry of the mass matrix is printed, if it fits a line."""


def equations(subject: Subject) -> list[Block]:
    """Return the section."""
    found = subject.equations
    verb = "is" if len(found.residuals) == 1 else "are"
    sentence = f"There {verb} {counted(len(found.residuals), 'equation')} of motion"
    if found.constraints:
        sentence += f" and {counted(len(found.constraints), 'constraint')}"
    if found.states:
        sentence += f", with {counted(len(found.states), 'state')} beside the mechanics"
    text = one_formula(found.latex()) if found.is_readable else None
    if text is not None and text.count(r"\\ ") < ROWS:
        return [Heading("Equations of motion"), prose(f"{sentence}."), Formula(text)]
    return [Heading("Equations of motion"), *_summary(subject, sentence), *_mass_matrix(subject)]


def _summary(subject: Subject, sentence: str) -> list[Block]:
    """Return the operations of the first and the last equations."""
    found = subject.equations
    rows: tuple[tuple[Words, ...], ...] = tuple(
        (("...",), ("...",)) if size is None else ((Math(latex(size[0])),), (str(size[1]),))
        for size in sizes_by_speed(found.system, found.residuals)
    )
    operations = counted(subject.cost.total, "operation")
    summary = (
        f"{sentence}, of {operations} altogether. They would fill pages: equations.residuals contains them."
    )
    return [prose(summary), Table(("equation of", "operations"), rows)]


def _mass_matrix(subject: Subject) -> list[Block]:
    """Return the operations of the entries, and the entries that can be read; nothing of a large matrix."""
    mass = subject.equations.mass_matrix
    n, is_symmetric = mass.rows, mass == mass.T
    if n > MATRIX:
        return []
    places = [(i, j) for i in range(n) for j in range(i if is_symmetric else 0, n)]
    forms = dict(zip(places, subject.read([mass[place] for place in places]), strict=True))
    header = ("operations", *(str(j + 1) for j in range(n)))
    rows = tuple(
        (
            (str(i + 1),),
            *((_size(forms[min(i, j), max(i, j)] if is_symmetric else forms[i, j]),) for j in range(n)),
        )
        for i in range(n)
    )
    symmetric = ", which is symmetric," if is_symmetric else ""
    lead = f"The entries of the mass matrix{symmetric} have these operations; where nothing stands, they are zero."
    return [prose(lead), Table(header, rows), *_short_entries(forms, "," * (n >= _TWO_DIGITS))]


def _size(entry: Expr) -> str:
    return "" if entry.is_zero else str(cost(entry).total)


def _short_entries(forms: Mapping[tuple[int, int], Expr], comma: str) -> Sequence[Block]:
    """Return the entries that fit a line."""
    short = {place: form for place, form in forms.items() if not form.is_zero and _fits_a_line(form)}
    names = [f"M_{{{i + 1}{comma}{j + 1}}}" for i, j in short]
    return equalities(prose("Its short entries are"), names, [*short.values()]) if short else []


def _fits_a_line(form: Expr) -> bool:
    return cost(form).total <= SHORT and width(latex(form)) <= LINE


_TWO_DIGITS = 10
"""The rows from which on indices have two digits."""
