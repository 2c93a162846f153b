"""Equations that fill more pages than a person reads: those that are short, and the sizes of the others."""

from __future__ import annotations

from collections.abc import Sequence

from symbody.symbolic import Expr
from symbody.symbolic.expression.text_layout import LINE
from symbody.symbolic.given.arguments import counted

from .equation_page import EquationPage
from .page import Page, lines_of, shorter
from .reader_of import reader_of
from .row import printed
from .summary import total

PAGES = 100
"""The lines up to which equations are written out: two pages."""
_SHORT, _ALL = 8, 50
"""The lines of an equation, and of all, up to which short equations are written out beside the sizes of long ones."""
_INDENT = "    "
_LINE = LINE - len(_INDENT)


def pages_of(page: Page) -> list[EquationPage]:
    """Return each equation of a page on a page of its own."""
    speeds = page.system.driving
    return [
        EquationPage(page.system, speed, balance, page.named)
        for speed, balance in zip(speeds, page.balances, strict=True)
    ]


def abridged(page: Page, residuals: Sequence[Expr]) -> str:
    """Return the equations and constraints that take few lines, the sizes of the others, and how to see these."""
    entries = [(f"equation of {each.speed}", each.texts) for each in pages_of(page)]
    shown, left = list[str](), _ALL
    for name, texts in (*entries, *_constraints(page)):
        size = len(lines_of(texts))
        is_short = size <= min(_SHORT, left)
        left -= size * is_short
        lines = [f"{_INDENT}{line}" for line in lines_of(texts, _LINE)]
        shown += [f"{_INDENT}{name}:", *lines] if is_short else [f"{_INDENT}{name}: {counted(size, 'line')}"]
    title = f"EQUATIONS OF MOTION of {total(page.system, residuals)}"
    advice = _ADVICE.format(lines=page.description().count("\n"), first=page.system.driving[0])
    return "\n".join([title, *shown, *advice.splitlines()])


def _constraints(page: Page) -> list[tuple[str, list[str]]]:
    """Return the names of the constraints, and the texts of each with the names that it needs."""
    made, reader = list[tuple[str, list[str]]](), reader_of(page.system)
    for each in page.conditions:
        shared, (text,) = printed([shorter(each.condition, reader)], "text", page.system)
        texts = [*(f"{name} := {value}" for name, value in shared), f"{text} = 0"]
        made.append((each.label, texts))
    return made


_ADVICE = """\
    Too long to be read at once. One of them: show(equations.equation_of({first}));
    all of the {lines} lines: print(equations.description(whole=True));
    one entry of the mass matrix: readable(equations.mass_matrix[0, 0])."""
