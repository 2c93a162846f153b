"""What writes expressions, as the tables of commands know it."""

from __future__ import annotations

from typing import Any, Protocol

from symbody.worksheet.convert.names import Names
from symbody.worksheet.sheet import syntax

__all__ = ["Arguments", "Writer"]

Arguments = tuple[syntax.Expression, ...]


class Writer(Protocol):
    """A writer of expressions; see `symbody.worksheet.convert.expressions.PythonText`."""

    names: Names
    as_differences: bool

    def text(self, node: syntax.Expression) -> str:
        """Return an expression as Python writes it."""
        ...

    def value(self, text: str) -> Any:
        """Return the value of a text that has been written, for its kind."""
        ...

    def item(self, node: syntax.Expression) -> str:
        """Return an item of a list, or an argument; a sequence is opened."""
        ...

    def items(self, nodes: Arguments) -> str:
        """Return items behind each other."""
        ...

    def comprehension(self, each: syntax.Expression, span: syntax.Expression) -> str:
        """Return a list over a range, or over the items of a list."""
        ...

    def axis(self, node: syntax.Expression) -> str:
        """Return an axis of rotation."""
        ...

    def frame(self, node: syntax.Expression) -> str:
        """Return a frame as commands take it."""
        ...

    def components(self, arguments: Arguments) -> str:
        """Return the components of a vector, or the coordinates of a point."""
        ...

    def within(self, names: Names) -> Writer:
        """Return the writer inside a loop or a function."""
        ...
