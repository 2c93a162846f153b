"""Expressions as rows of plain data, for pickling: another process builds the same forms from them."""

from __future__ import annotations

from collections.abc import Iterable
from fractions import Fraction
from typing import Any, TypeAlias

from symbody.symbolic import _core
from symbody.symbolic._core import Expr
from symbody.symbolic.expression.linear_solution import linear_solution
from symbody.symbolic.expression.traverse import post_order

__all__ = ["Encoded", "decode", "encode", "reduced"]

#: A node: its kind, the positions of its parts among the earlier rows, and its other data.
Row: TypeAlias = tuple[str, tuple[int, ...], tuple[Any, ...]]

#: Rows, parts first, and the positions of the expressions among them.
Encoded: TypeAlias = tuple[tuple[Row, ...], tuple[int, ...]]


def encode(expressions: Iterable[Expr]) -> Encoded:
    """Return several expressions as rows; a node that they share is one row."""
    roots = tuple(expressions)
    places: dict[int, int] = {}
    rows: list[Row] = []
    for node in post_order(roots, lambda e: e.args, lambda e: e.id):
        places[node.id] = len(rows)
        rows.append((node.kind, tuple(places[part.id] for part in node.args), _data(node)))
    return tuple(rows), tuple(places[root.id] for root in roots)


def decode(encoded: Encoded) -> tuple[Expr, ...]:
    """Return the expressions that :func:`encode` encoded."""
    rows, roots = encoded
    made: list[Expr] = []
    for kind, parts, data in rows:
        made.append(_node(kind, [made[part] for part in parts], data))
    return tuple(made[root] for root in roots)


def reduced(expression: Expr) -> tuple[Any, tuple[Encoded]]:
    """Return the value of ``Expr.__reduce__``: a function and the arguments from which it makes the expression."""
    return _single, (encode([expression]),)


def _single(encoded: Encoded) -> Expr:
    (expression,) = decode(encoded)
    return expression


def _data(e: Expr) -> tuple[Any, ...]:
    match e.kind:
        case "number":
            return (*e.ratio, e.is_decimal)
        case "symbol" if not e.same_form(_core.time()):
            return e.name, e.assumption
        case "time_function":
            return e.name, e.order, e.assumption == "small"
        case "application":
            return e.name, tuple(e.orders)
        case "function":
            return (e.name,)
        case _:
            return ()


def _node(kind: str, parts: list[Expr], data: tuple[Any, ...]) -> Expr:
    match kind:
        case "sum":
            return _core.sum_of(parts)
        case "product":
            return _core.product_of(parts)
        case "power":
            base, exponent = parts
            return base**exponent
        case "function":
            return _core.apply(data[0], parts)
        case "solution":
            return linear_solution(*parts)
        case "application":
            name, orders = data
            return _core.application(name, parts, orders)
        case _:
            return _leaf(kind, data)


def _leaf(kind: str, data: tuple[Any, ...]) -> Expr:
    match kind, data:
        case "number", (numerator, denominator, decimal):
            return _number(numerator, denominator, decimal)
        case "time_function", (name, order, small):
            return _core.time_function(name, order, small=small)
        case "symbol", (name, assumption):
            return _core.symbol(
                name,
                positive=assumption == "positive",
                real=assumption != "none",
                small=assumption == "small",
            )
        case _:
            return _core.time() if kind == "symbol" else _core.pi()


def _number(numerator: int, denominator: int, decimal: bool) -> Expr:  # noqa: FBT001 - a row of data
    """Return the number, marked as a decimal if it was one: the product with 1.0 is marked."""
    exact = _core.number(Fraction(numerator, denominator))
    return exact * 1.0 if decimal else exact
