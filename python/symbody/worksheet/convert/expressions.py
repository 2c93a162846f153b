"""Expressions of Maple as Python writes them, with the names of a program."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from symbody.worksheet.convert.calls import arrow, call
from symbody.worksheet.convert.matrix_displays import columns, rows
from symbody.worksheet.convert.name_text import concatenation, name_text
from symbody.worksheet.convert.names import Names, NoText
from symbody.worksheet.convert.operators import infix, postfix, prefix
from symbody.worksheet.convert.selections import selection
from symbody.worksheet.convert.sequences import distinct, items, listed
from symbody.worksheet.convert.writer import Called, Writer
from symbody.worksheet.sheet import syntax

__all__ = ["PythonText"]


class PythonText:
    """The text of expressions.

    Attributes:
        names: the names of the program.
        last: the variable that holds what ``%`` means.
        called: writes the definition of a procedure when it is first called.
        as_differences: whether ``x = 3`` is ``x - 3``, as an equation to be solved, and not ``{x: 3}``.
        shown: the expressions that the statement shows.
    """

    def __init__(
        self,
        names: Names,
        last: str = "",
        called: Called = lambda text, name, arguments: None,
    ) -> None:
        self.names, self.last, self.called = names, last, called
        self.as_differences = names.as_differences
        self.shown: list[str] = []

    def within(self, names: Names) -> PythonText:
        """Return the writer inside a loop or a function."""
        inner = PythonText(names, "", self.called)
        inner.as_differences = self.as_differences
        return inner

    def text(self, node: syntax.Expression) -> str:
        """Return an expression as Python writes it.

        Raises:
            NoText: there is no text for it.
        """
        writer = _WRITERS.get(type(node))
        if writer is None:
            raise NoText(type(node).__name__)
        return writer(self, node)

    def value(self, text: str) -> Any:
        """Return the value of a text that has been written, for its kind."""
        return self.names.value(text)


def _ditto(text: Writer, node: syntax.Ditto) -> str:
    if node.level > 1 or not text.last:
        raise NoText("%")
    return text.last


def _decimal(text: PythonText, node: syntax.Decimal) -> str:
    return f'sb.number("{node.text}")'


_WRITERS: Mapping[type, Callable[[PythonText, Any], str]] = {
    syntax.Integer: lambda text, node: str(node.value),
    syntax.Decimal: _decimal,
    syntax.Text: lambda text, node: repr(node.text),
    syntax.Name: name_text,
    syntax.Ditto: _ditto,
    syntax.Delayed: lambda text, node: text.text(node.body),
    syntax.Prefix: prefix,
    syntax.Infix: infix,
    syntax.Postfix: postfix,
    syntax.Concatenation: concatenation,
    syntax.ListDisplay: lambda text, node: listed(text, node.items),
    syntax.SetDisplay: lambda text, node: distinct(text, listed(text, node.items)),
    syntax.SequenceDisplay: lambda text, node: f"({items(text, node.items)})",
    syntax.Selection: selection,
    syntax.Call: call,
    syntax.Arrow: arrow,
    syntax.Columns: columns,
    syntax.Rows: rows,
}
