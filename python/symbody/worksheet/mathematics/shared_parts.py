"""Computation sequences: parts that occur several times get names t1, t2, ..."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from functools import reduce
from operator import add, mul

from symbody.symbolic import Expr, UndefinedFunction
from symbody.symbolic.expression import functions
from symbody.symbolic.expression.traverse import post_order
from symbody.worksheet.values.naming import symbol

__all__ = ["computation_sequence", "named_parts"]

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


def computation_sequence(
    names: Sequence[str | None], expressions: list[Expr], taken: frozenset[str] = frozenset()
) -> list[tuple[Expr | None, Expr]]:
    """Return the steps that give each name its expression: parts with their names, results without, in their order.

    A part that contains one of the names stands behind the result of this name. Where a name is read both before and
    after it gets its value, equal parts are different values, so that none is shared.
    """
    if _is_reused(names, expressions):
        return [(None, expression) for expression in expressions]
    definitions, shortened = named_parts(expressions, taken | _names_in(expressions))
    return list(_in_order(definitions, frozenset(name for name in names if name is not None), shortened))


def _in_order(
    definitions: list[tuple[Expr, Expr]], assigned: frozenset[str], results: list[Expr]
) -> Iterator[tuple[Expr | None, Expr]]:
    waiting: dict[str, tuple[Expr, Expr]] = {}
    for name, definition in definitions:
        if _names_in([definition]) & (assigned | waiting.keys()):
            waiting[name.name] = (name, definition)
        else:
            yield name, definition
    for result in results:
        for part in _needed(result, waiting):
            yield waiting.pop(part)
        yield None, result


def _needed(expression: Expr, waiting: dict[str, tuple[Expr, Expr]]) -> list[str]:
    """Return the parts that an expression needs and that wait, in an order in which they can be computed."""
    needed: set[str] = set()
    read = set(_names_in([expression]))
    for name, (_, definition) in reversed(waiting.items()):
        if name in read:
            needed.add(name)
            read |= _names_in([definition])
    return [name for name in waiting if name in needed]


def _is_reused(names: Sequence[str | None], expressions: list[Expr]) -> bool:
    """Whether a name is read both up to the result that gives it a value and behind it, or gets two values."""
    read = [_names_in([expression]) for expression in expressions]
    for place, name in enumerate(names):
        if name is None:
            continue
        is_read_before = any(name in each for each in read[: place + 1])
        if is_read_before and any(name in each for each in read[place + 1 :]):
            return True
    known = [name for name in names if name is not None]
    return len(set(known)) < len(known)


def _names_in(expressions: list[Expr]) -> frozenset[str]:
    return frozenset(each.name for expression in expressions for each in expression.free_symbols)


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
