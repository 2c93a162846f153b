"""What is within a node of syntax: the nodes, those of a kind, and names that are replaced."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import fields, is_dataclass, replace
from typing import Any

from symbody.worksheet.sheet import syntax

__all__ = ["mentions", "nodes_in", "replaced", "rewritten"]


def nodes_in(node: object) -> Iterator[object]:
    """Yield a node, or those of a tuple, and all nodes within, in no particular order."""
    stack = [node]
    while stack:
        part = stack.pop()
        if isinstance(part, tuple):
            stack += part
        elif is_dataclass(part):
            yield part
            stack += [getattr(part, each.name) for each in fields(part) if each.name != "place"]


def mentions(node: object, kind: type) -> bool:
    """Whether a node holds one of a kind, or is one."""
    return any(isinstance(each, kind) for each in nodes_in(node))


def replaced(node: Any, name: str, value: syntax.Expression) -> Any:
    """Return syntax with a name replaced, also inside quotes."""
    if isinstance(node, syntax.Name):
        return value if node.name == name else node
    if isinstance(node, syntax.Delayed) and isinstance(node.body, syntax.Name) and node.body.name == name:
        return value
    if isinstance(node, tuple):
        return tuple(replaced(each, name, value) for each in node)
    if not is_dataclass(node) or isinstance(node, syntax.Place):
        return node
    changes = {
        each.name: new
        for each in fields(node)
        if each.name != "place"
        and (new := replaced(getattr(node, each.name), name, value)) is not getattr(node, each.name)
    }
    return replace(node, **changes) if changes else node  # type: ignore[type-var]


def rewritten(node: Any, change: Callable[[Any], Any]) -> Any:
    """Return syntax in which each node is what a function makes of it, after those within."""
    if isinstance(node, tuple):
        return tuple(rewritten(each, change) for each in node)
    if not is_dataclass(node) or isinstance(node, syntax.Place | type):
        return node
    parts = {each.name: getattr(node, each.name) for each in fields(node) if each.name != "place"}
    changes = {name: new for name, part in parts.items() if (new := rewritten(part, change)) is not part}
    return change(replace(node, **changes) if changes else node)
