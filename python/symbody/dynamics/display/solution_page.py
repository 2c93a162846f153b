"""Solved equations of motion on a page: each acceleration and each multiplier in its form for the reader."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

from symbody.multibody import Variables
from symbody.symbolic import Expr, cost, latex, substitute
from symbody.symbolic.expression.latex_layout import ARTICLE, aligned, broken, in_pages
from symbody.symbolic.expression.text_layout import ends
from symbody.symbolic.given.arguments import counted

from .determinant import over_determinant, printed_rows
from .names_of_formulas import with_one_naming
from .page import indented
from .reader_of import reader_of
from .short_names import Definition, shortened
from .summary import READABLE

_MOST = 30
"""The values up to which they are written out."""
_AT_ONCE = 200
"""The shortest form of each value is searched if all values have at most so many operations."""


@dataclass(frozen=True)
class SolutionPage:
    """Accelerations and multipliers in the form for the reader.

    Attributes:
        system: the system to which the equations belong.
        values: the accelerations and multipliers, and their values.
    """

    system: Variables
    values: Mapping[Expr, Expr]

    @property
    def is_readable(self) -> bool:
        """Whether the values are short enough to be written out."""
        return len(self.values) <= _MOST and cost(list(self.values.values())).total <= READABLE

    def description(self) -> str:
        """Return a line for each value, after the quantities that have names; of long values, their sizes."""
        if self.is_readable:
            definitions, rows = self._rows("text")
            texts = [f"{name} := {value}" for name, value in definitions]
            texts += [f"{unknown} = {side}" for unknown, side in rows]
            if self._solved:
                texts.append(f"{', '.join(map(str, self._solved))}: {self._note}")
        else:
            texts = ["..." if each is None else f"{each[0]}: {each[1]}" for each in ends(self._sizes)]
            texts.append("Too long to be read at once. One of them: readable(solution.accelerations[0]).")
        names = ["..." if each is None else str(each) for each in ends(self.system.driving)]
        title = f"ACCELERATIONS of {', '.join(names if len(self.values) > _MOST else map(str, self.system.driving))}"
        return "\n".join([title, *(line for text in texts for line in indented(text))])

    @with_one_naming
    def latex(self) -> str:
        """Return a row for each value in LaTeX, after the quantities that have names; of long values, their sizes."""
        if not self.is_readable:
            sizes = ends(self._sizes)
            return aligned(
                [
                    r"&\;\vdots" if each is None else rf"{latex(each[0])} &\colon \text{{{each[1]}}}"
                    for each in sizes
                ]
            )
        definitions, rows = self._rows("latex")
        named = [*definitions, *((latex(unknown), side) for unknown, side in rows)]
        made = [line for name, value in named for line in broken(f"{name} &= ", value, ARTICLE)]
        if self._solved:
            made.append(rf"&{', '.join(map(latex, self._solved))} \colon \text{{{self._note}}}")
        return in_pages(aligned(made))

    @cached_property
    def _solved(self) -> dict[Expr, Expr]:
        """The unknowns that a linear system gives at run time, and each one's place in it, if need be over a factor."""
        made = {unknown: _place_in_system(value) for unknown, value in self.values.items()}
        return {unknown: place for unknown, place in made.items() if place is not None}

    @property
    def _note(self) -> str:
        return f"by a linear system of {counted(len(self._solved), 'equation')} that is solved at run time"

    @property
    def _sizes(self) -> list[tuple[Expr, str]]:
        return [(unknown, counted(cost(value).total, "operation")) for unknown, value in self.values.items()]

    def _rows(self, notation: str) -> tuple[list[Definition], list[tuple[Expr, str]]]:
        """Return named quantities, and the values that have a form, by the names of those that are solved for."""
        reader = reader_of(self.system)
        names = {place: unknown * place / self.values[unknown] for unknown, place in self._solved.items()}
        given = {unknown: value for unknown, value in self.values.items() if unknown not in self._solved}
        values = [(value,) for value in substitute(list(given.values()), names)]
        read = reader.shortest_form if cost([each for (each,) in values]).total <= _AT_ONCE else reader
        forms = [tuple(map(read, row)) for row in values]
        divided = over_determinant(values, self.system, reader)
        definitions, texts = printed_rows(forms, divided, notation, self.system)
        definitions, sides = shortened(texts, (), definitions, notation)
        return definitions, list(zip(given, sides, strict=True))


def _place_in_system(value: Expr) -> Expr | None:
    """Return the unknown of a linear system that a value is, or is a multiple of; None if it is another expression."""
    factors = value.args if value.kind == "product" else (value,)
    places = [factor for factor in factors if factor.kind == "solution"]
    others = [factor for factor in factors if factor.kind != "solution"]
    is_multiple = len(places) == 1 and all(factor.kind in {"number", "symbol"} for factor in others)
    return places[0] if is_multiple else None
