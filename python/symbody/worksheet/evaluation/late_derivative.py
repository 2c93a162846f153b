"""Derivatives of functions that nobody knew when they were written: ``D(f)(x)``, once f has a value."""

from __future__ import annotations

from typing import Protocol

from symbody.errors import SymbodyError
from symbody.symbolic import Expr
from symbody.worksheet.values.naming import symbol
from symbody.worksheet.values.value import Value

__all__ = ["derivative_at"]


class Caller(Protocol):
    """What calls functions: a session."""

    def call(self, function: Value, arguments: tuple[Value, ...]) -> Value:
        """Return the value of a function at arguments."""


def derivative_at(session: Caller, function: Value, node: Expr, arguments: tuple[Value, ...]) -> Value:
    """Return what a derivative becomes with a function: ``D(f)(x)`` of ``f := z -> z^2`` is 2*x.

    Args:
        session: the session.
        function: the function that has a value by now, or that takes the place of another one.
        node: the derivative; the answer if the function has none that is known.
        arguments: the present values of its arguments.
    """
    are_names = all(each.kind == "symbol" for each in node.args) and len({*node.args}) == len(node.args)
    places = node.args if are_names else tuple(symbol(f"_place{k}") for k in range(len(node.args)))
    try:
        found = session.call(function, tuple(places))
    except SymbodyError:  # a procedure that needs numbers
        return node
    if not isinstance(found, Expr) or found.kind == "application":
        return node
    for place, order in zip(places, node.orders, strict=True):
        for _ in range(order):
            found = found.diff(place)
    at = {x: each for x, each in zip(places, arguments, strict=True) if isinstance(each, Expr)}
    return found.subs(at) if len(at) == len(places) else node
