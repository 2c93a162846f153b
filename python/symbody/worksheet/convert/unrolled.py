"""Loops over names that are joined of pieces, which are written out: ``crank||n`` is crank1, crank2, crank3."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import fields, is_dataclass, replace
from typing import Any, TypeVar

from symbody.worksheet.convert.names import NoText
from symbody.worksheet.convert.writer import Writer
from symbody.worksheet.sheet import syntax

__all__ = ["at_values", "mentions_joined_names"]

#: How many times a loop is written out.
_LONGEST = 24

Node = TypeVar("Node")


def at_values(
    to: Writer, node: Node, variable: str, first: syntax.Expression | None, last: syntax.Expression | None
) -> Iterator[Node]:
    """Return a node for each value of an index, with the value in the place of the index.

    Args:
        to: writes the bounds.
        node: an expression, or statements.
        variable: the index.
        first: its first value; 1 if there is none.
        last: its last value.

    Raises:
        NoText: the bounds are no numbers here, or too far from each other.
    """
    bounds = [1 if each is None else to.value(to.text(each)) for each in (first, last)]
    a, b = bounds
    if not isinstance(a, int) or not isinstance(b, int) or not b - a < _LONGEST:
        raise NoText("||")
    for value in range(a, b + 1):
        yield _at(node, variable, value)


def mentions_joined_names(node: Any) -> bool:
    """Whether a name that is joined of pieces occurs in a node: ``a || i``."""
    if isinstance(node, tuple):
        return any(mentions_joined_names(each) for each in node)
    if not is_dataclass(node):
        return False
    parts = (getattr(node, each.name) for each in fields(node) if each.name != "place")
    return isinstance(node, syntax.Concatenation) or any(mentions_joined_names(part) for part in parts)


def _at(node: Any, variable: str, value: int) -> Any:
    """Return a node with a number in the place of an index."""
    if isinstance(node, tuple):
        return tuple(_at(each, variable, value) for each in node)
    if isinstance(node, syntax.Name) and node.name == variable:
        return syntax.Integer(value, place=node.place)
    if not is_dataclass(node) or isinstance(node, type):
        return node
    parts = {each.name: getattr(node, each.name) for each in fields(node) if each.name != "place"}
    return replace(node, **{name: _at(part, variable, value) for name, part in parts.items()})
