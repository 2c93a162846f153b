"""The terms of a sum."""

from __future__ import annotations

from symbody.symbolic._core import Expr, number


def summands(expression: Expr) -> list[Expr]:
    """Return the terms of a sum, also of sums among them that a number multiplies; at least one.

    >>> from symbody import symbols
    >>> a, b, c = symbols("a b c")
    >>> summands(c - 2 * (a + b))
    [c, -2*a, -2*b]
    """
    found, left = list[Expr](), [(expression, number(1))]
    while left:
        part, factor = left.pop()
        if part.kind == "sum":
            left.extend((arg, factor) for arg in reversed(part.args))
        elif multiple := _multiple(part):
            left.append((multiple[1], factor * multiple[0]))
        else:
            found.append(factor * part)
    return found


def _multiple(part: Expr) -> tuple[Expr, Expr] | None:
    """Return the number and the other factor of a product of two."""
    if part.kind != "product" or len(part.args) != 2:
        return None
    one, other = part.args
    if one.is_number == other.is_number:
        return None
    return (one, other) if one.is_number else (other, one)
