"""Roots and inverse functions on their main branch, as ``simplify(e, symbolic)`` takes them: ``sqrt(x^2)`` is x."""

from __future__ import annotations

from symbody.symbolic import Expr, number
from symbody.symbolic.expression.traverse import post_order

__all__ = ["with_positive_roots"]

_INVERSES = {"asin": "sin", "acos": "cos", "atan": "tan"}

#: How often roots within roots are rewritten.
_DEPTH = 8


def with_positive_roots(value: Expr) -> Expr:
    """Return an expression as if each factor under a root, and each argument of ``abs``, were positive."""
    for _ in range(_DEPTH):
        nodes = post_order([value], lambda node: node.args, lambda node: node.id)
        made = {node: new for node in nodes if (new := _on_main_branch(node)) is not None}
        if not made:
            break
        value = value.subs(made)
    return value


def _on_main_branch(node: Expr) -> Expr | None:
    """Return what a node becomes; None if it stays."""
    match node.kind, node.args:
        case "power", (base, exponent) if exponent.kind == "number" and exponent.ratio[1] != 1:
            return _root(base, exponent)
        case "function", (inner,) if node.name == "Abs":
            return inner
        case "function", (inner,) if inner.kind == "function" and inner.name == _INVERSES.get(node.name):
            return inner.args[0]
    return None


def _root(base: Expr, exponent: Expr) -> Expr | None:
    """Return a root of a product with whole powers taken out: ``x*y^(1/2)`` for ``(x^2*y)^(1/2)``."""
    outside, inside = number(1), number(1)
    for factor in base.args if base.kind == "product" else (base,):
        x, power = factor.args if factor.kind == "power" else (factor, number(1))
        whole = (power * exponent).ratio[0] // (power * exponent).ratio[1] if power.kind == "number" else 0
        if factor.kind == "number" or not whole:
            inside *= factor
        else:
            outside *= x**whole
            inside *= x ** (power - whole / exponent)
    return None if outside == 1 else outside * inside**exponent
