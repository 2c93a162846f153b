"""Traversal of a graph."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import TypeVar

__all__ = ["post_order"]

Node = TypeVar("Node")


def post_order(
    roots: Iterable[Node], parts: Callable[[Node], Iterable[Node]], key: Callable[[Node], int]
) -> list[Node]:
    """Return the nodes below the roots, parts first, each once. A loop, because expressions are deep."""
    order: list[Node] = []
    seen: set[int] = set()
    stack = [(root, False) for root in roots]
    while stack:
        node, expanded = stack.pop()
        if expanded:
            order.append(node)
        elif key(node) not in seen:
            seen.add(key(node))
            stack.append((node, True))
            stack.extend((part, False) for part in parts(node))
    return order
