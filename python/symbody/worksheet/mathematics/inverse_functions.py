"""Sines, cosines and tangents of inverse functions in algebraic form: ``cos(arctan(u))`` is ``1/(1+u^2)^(1/2)``."""

from __future__ import annotations

from symbody.symbolic import Expr, sqrt
from symbody.worksheet.values.structure import tree_of, walk

__all__ = ["has_inverse", "of_inverse", "without_inverses"]

_INVERSES = frozenset({"asin", "acos", "atan"})


def of_inverse(name: str, argument: Expr) -> Expr | None:
    """Return the sine, cosine or tangent of an inverse function, as Maple evaluates it; None for other functions."""
    if argument.kind != "function" or argument.name not in _INVERSES:
        return None
    (u,) = argument.args
    length = sqrt(1 + u**2)
    sine, cosine = {
        "asin": (u, sqrt(1 - u**2)),
        "acos": (sqrt(1 - u**2), u),
        "atan": (u / length, 1 / length),
    }[argument.name]
    match name:
        case "sin":
            return sine
        case "cos":
            return cosine
        case "tan":
            return u if argument.name == "atan" else sine / cosine
    return None


def has_inverse(value: Expr) -> bool:
    """Whether an expression is an inverse function or contains one."""
    return any(node.kind == "function" and node.value.name in _INVERSES for node in walk(tree_of(value)))


def without_inverses(value: Expr) -> Expr:
    """Return an expression without sines, cosines and tangents of inverse functions."""
    found = {}
    for node in walk(tree_of(value)):
        if node.kind == "function" and len(node.value.args) == 1:
            made = of_inverse(node.value.name, node.value.args[0])
            if made is not None:
                found[node.value] = made
    return value.subs(found) if found else value
