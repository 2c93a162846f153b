"""Unrolled loops over concatenated names: ``crank||n`` is crank1, crank2, crank3."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TypeVar

from symbody.worksheet.convert.names import NoText
from symbody.worksheet.convert.writer import Writer
from symbody.worksheet.sheet import syntax
from symbody.worksheet.sheet.within import replaced

__all__ = ["at_values"]

#: The largest number of passes of a loop that is unrolled.
_LONGEST = 24

Node = TypeVar("Node")


def at_values(
    to: Writer, node: Node, variable: str, first: syntax.Expression | None, last: syntax.Expression | None
) -> Iterator[Node]:
    """Yield a node for each value of an index, with the value in place of the index.

    Args:
        to: writes the bounds.
        node: an expression, or statements.
        variable: the index.
        first: its first value; 1 if there is none.
        last: its last value.

    Raises:
        NoText: the bounds are not known integers, or are too far apart.
    """
    if last is None:
        raise NoText("do")
    a, b = (1 if each is None else to.value(to.text(each)) for each in (first, last))
    if not isinstance(a, int) or not isinstance(b, int) or not b - a < _LONGEST:
        raise NoText("||")
    for value in range(a, b + 1):
        yield replaced(node, variable, syntax.Integer(value, place=last.place))
