"""Data sheets of joints, links, reactions and the like: labelled rows as text, in LaTeX and in notebooks."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple, final

from symbody.geometry import Frame
from symbody.geometry.frame.chain import Chain
from symbody.symbolic import Expr, cost, latex, listing
from symbody.symbolic.calculus.shown_form import shown_form
from symbody.symbolic.expression.container import Container, contains, text_of
from symbody.symbolic.expression.html_table import html_table
from symbody.symbolic.expression.latex_layout import aligned, upright
from symbody.symbolic.given.arguments import brief, counted

__all__ = ["DataSheet", "Row", "WithSheet"]


class Row(NamedTuple):
    """A label and its value: words, an expression, a frame, or a tuple of expressions, followed by further words.

    Attributes:
        label: what the value is.
        value: the value.
        words: what follows it.
        axes: the frame in whose axes it is; None if that doesn't matter.
    """

    label: str
    value: Any
    words: str = ""
    axes: Frame | None = None

    @property
    def is_formula(self) -> bool:
        """Whether the value is not only words."""
        return not isinstance(self.value, str)

    def written(self, value: str) -> str:
        """Return the value, which is given as text, with what follows it."""
        axes = "" if self.axes is None else f"{_IN_AXES} {brief(self.axes)}"
        return " ".join(part for part in (value, self.words, axes) if part)


_IN_AXES = "in the axes of"


@final
@dataclass(frozen=True, eq=False)
class DataSheet:
    r"""A title, and rows of a label and a value.

    >>> from symbody import symbols
    >>> sheet = DataSheet("Rod", (Row("made of", "steel"), Row("mass", symbols("rho") * 2)))
    >>> print(sheet.text)
    Rod
        made of: steel
        mass: 2*rho
    >>> print(sheet.latex)
    \begin{aligned} \text{made of} &: \text{steel} \\ \text{mass} &: 2 \rho \end{aligned}
    """

    title: str
    rows: tuple[Row, ...]

    @property
    def text(self) -> str:
        """What `show` prints: quantities that long expressions share, then one line for each row."""
        shared, entries = self._entries()
        rows = (f"{row.label}: {entry}" for row, entry in zip(self.rows, entries, strict=True))
        return "\n".join([self.title, *shared, *rows]).replace("\n", "\n    ")

    @property
    def latex(self) -> str:
        """The rows as one formula."""
        return latex(self)

    @property
    def html(self) -> str:
        """The rows as a table of a notebook, in which long values are shortened."""
        rows = [[row.label, row.written(_text(row.value, _in_a_cell))] for row in self.rows]
        return html_table(self.title, ["field", "value"], rows)

    def _entries(self) -> tuple[list[str], list[str]]:
        """Return the lines of shared quantities, and the text of each row."""
        expressions = list[Expr]()

        def collect(expression: Expr) -> str:
            expressions.append(shown_form(expression))
            return ""

        for row in self.rows:
            _text(row.value, collect)
        definitions, texts = listing(expressions)
        remaining = iter(texts)
        entries = [row.written(_text(row.value, lambda _: next(remaining))) for row in self.rows]
        return [f"{name} = {value}" for name, value in definitions], entries


class WithSheet(ABC):
    """Base of the classes that `show`, `latex` and notebooks display as a data sheet."""

    @property
    @abstractmethod
    def sheet(self) -> DataSheet:
        """The data sheet."""

    def description(self) -> str:
        """Return what `show` prints."""
        return self.sheet.text

    def latex(self) -> str:
        """Return the rows of the data sheet in LaTeX, without dollar signs."""
        return self.sheet.latex

    def _repr_html_(self) -> str:
        return self.sheet.html


def _text(value: Any, of_expression: Callable[[Expr], str]) -> str:
    """Return a value as text, with its expressions converted by a given function."""
    if isinstance(value, Expr):
        return of_expression(value)
    return text_of(value, lambda part: _text(part, of_expression)) or str(value)


def _in_a_cell(expression: Expr) -> str:
    """Return an expression as text, or its size if the text has several lines."""
    text = str(shown_form(expression))
    return f"({counted(cost(expression).total, 'operation')})" if "\n" in text else text


def _layout(sheet: DataSheet, texts: list[str]) -> str:
    formulas = iter(texts)
    rows = []
    for row in sheet.rows:
        parts = [next(formulas) if row.is_formula else upright(row.value)]
        if row.words:
            parts.append(upright(row.words))
        if row.axes is not None:
            parts += [upright(_IN_AXES), next(formulas)]
        rows.append(rf"{upright(row.label)} &: " + r"\ ".join(parts))
    return aligned(rows)


def _formulas(sheet: DataSheet) -> list[Any]:
    """Return the values that are no words, each with the axes in which it is."""
    found = []
    for row in sheet.rows:
        found += [row.value] if row.is_formula else []
        found += [] if row.axes is None else [row.axes]
    return found


def _shown(sheet: DataSheet) -> list[Any]:
    return [Chain(each) if isinstance(each, Frame) else each for each in _formulas(sheet)]


def _rebuilt(sheet: DataSheet, parts: Sequence[Any]) -> DataSheet:
    remaining = iter(parts)
    return DataSheet(
        sheet.title,
        tuple(
            row._replace(
                value=next(remaining) if row.is_formula else row.value,
                axes=None if row.axes is None else next(remaining),
            )
            for row in sheet.rows
        ),
    )


contains(
    DataSheet,
    Container(
        _formulas, _rebuilt, layout=_layout, shown=_shown, advice="the thing that it describes may have one"
    ),
)
