"""Computation sequences: parts that occur several times get names t1, t2, ..."""

from __future__ import annotations

from collections import Counter
from functools import reduce
from operator import add, mul

from symbody.symbolic import Expr, UndefinedFunction
from symbody.symbolic.expression import functions
from symbody.symbolic.expression.traverse import post_order
from symbody.worksheet.values.naming import symbol

__all__ = ["named_parts"]

_LEAVES = ("number", "constant", "symbol", "time_function", "solution")


def named_parts(
    expressions: list[Expr], taken: frozenset[str] = frozenset()
) -> tuple[list[tuple[Expr, Expr]], list[Expr]]:
    """Return names with their definitions, in an order in which they can be computed, and the expressions by names."""
    nodes = post_order(expressions, lambda node: node.args, lambda node: node.id)
    uses = Counter(part.id for node in nodes for part in node.args)
    uses.update(expression.id for expression in expressions)
    new: dict[int, Expr] = {}
    definitions: list[tuple[Expr, Expr]] = []
    count = 0
    for node in nodes:
        made = _with_parts(node, [new[part.id] for part in node.args])
        if uses[node.id] > 1 and node.kind not in _LEAVES and not _is_multiple(node):
            count += 1
            while f"t{count}" in taken:
                count += 1
            name = symbol(f"t{count}")
            definitions.append((name, made))
            made = name
        new[node.id] = made
    return definitions, [new[each.id] for each in expressions]


def _is_multiple(node: Expr) -> bool:
    """Whether a node is a number times a leaf, which costs no more than a name does."""
    return node.kind == "product" and len(node.args) == 2 and node.args[0] == -1


def _with_parts(node: Expr, parts: list[Expr]) -> Expr:
    if not parts or all(new is old for new, old in zip(parts, node.args, strict=True)):
        return node
    if node.kind == "sum":
        return reduce(add, parts)
    if node.kind == "product":
        return reduce(mul, parts)
    if node.kind == "power":
        return parts[0] ** parts[1]
    if node.kind == "application":
        return UndefinedFunction(node.name).derivative(node.orders, *parts)
    function = getattr(functions, node.name, None)
    return node if function is None or node.name == "Piecewise" else function(*parts)
