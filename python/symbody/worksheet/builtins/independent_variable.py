"""Functions of another variable than time, y(x): differential equations name it t while they are solved."""

from __future__ import annotations

from collections.abc import Iterator
from collections.abc import Sequence as Items

from symbody.symbolic import Expr, UndefinedFunction, diff, substitute, t, time_function
from symbody.worksheet.values.structure import tree_of, walk

__all__ = ["independent_variable", "of_time", "of_variable"]


def independent_variable(residuals: Items[Expr]) -> Expr:
    """Return the variable by which equations have derivatives: time, unless all functions are of another name."""
    found = {node.args[0] for node in _applications(residuals) if any(node.orders)}
    return found.pop() if len(found) == 1 and not any(_is_of_time(each) for each in residuals) else t


def _is_of_time(value: Expr) -> bool:
    return value.has(t) or any(leaf.kind == "time_function" for leaf in value.free_symbols)


def of_time(values: Items[Expr], variable: Expr) -> list[Expr]:
    """Return expressions with functions of time in place of those of a variable."""
    if variable == t:
        return list(values)
    changes = {
        node: time_function(node.name, node.orders[0])
        for node in _applications(values)
        if node.args[0] == variable
    }
    return list(substitute(list(substitute(list(values), changes)), {variable: t}))


def of_variable(value: Expr, variable: Expr) -> Expr:
    """Return an expression of functions of time as the sheet writes it, with those of a variable."""
    if variable == t:
        return value
    functions = [leaf for leaf in value.free_symbols if leaf.kind == "time_function"]
    changes = {leaf: UndefinedFunction(leaf.name)(variable) for leaf in functions}
    rates = {leaf: diff(changes[leaf], variable, leaf.order) for leaf in functions if leaf.order}
    return substitute((value,), {**changes, **rates, t: variable})[0]


def _applications(values: Items[Expr]) -> Iterator[Expr]:
    """Return the functions of one name in expressions, with their derivatives."""
    for value in values:
        for node in walk(tree_of(value)):
            is_one = node.value.kind == "application" and len(node.value.args) == 1
            if is_one and node.value.args[0].kind == "symbol":
                yield node.value
