"""What writes expressions, as the tables of commands know it."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Protocol, TypeAlias

from symbody.worksheet.convert.names import Names
from symbody.worksheet.sheet import syntax

__all__ = ["Arguments", "Called", "Writer"]

Arguments = tuple[syntax.Expression, ...]


Called: TypeAlias = "Callable[[Writer, str, Arguments], str | None]"


class Writer(Protocol):
    """A writer of expressions; see `symbody.worksheet.convert.expressions.PythonText`."""

    names: Names
    last: str
    called: Called
    as_differences: bool

    def text(self, node: syntax.Expression) -> str:
        """Return an expression as Python writes it."""
        ...

    def value(self, text: str) -> Any:
        """Return the value of a text that has been written, for its kind."""
        ...

    def within(self, names: Names) -> Writer:
        """Return the writer inside a loop or a function."""
        ...
