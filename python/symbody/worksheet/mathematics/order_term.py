"""What a series leaves out, ``O(x^n)``: a term that is printed, and that ``convert(.., polynom)`` takes away."""

from __future__ import annotations

from symbody.symbolic import Expr, UndefinedFunction, number
from symbody.symbolic.expression.traverse import post_order

__all__ = ["order_of_derivative", "order_term", "order_terms", "without_order"]

_NAME = "O"


def order_term(power: Expr) -> Expr:
    """Return O of a power."""
    return UndefinedFunction(_NAME)(power)


def order_of_derivative(term: Expr) -> Expr:
    """Return what the derivative of O(x^n) is: O(x^(n - 1))."""
    (power,) = term.args
    if power.kind == "power":
        return order_term(power.args[0] ** (power.args[1] - 1))
    return order_term(number(1))


def order_terms(value: Expr) -> list[Expr]:
    """Return the terms O(..) in a scalar."""
    nodes = post_order([value], lambda node: node.args, lambda node: node.id)
    return [
        node for node in nodes if node.kind == "application" and node.name == _NAME and len(node.args) == 1
    ]


def without_order(value: Expr) -> Expr:
    """Return a series as a polynomial."""
    return value.subs(dict.fromkeys(order_terms(value), number(0)))
