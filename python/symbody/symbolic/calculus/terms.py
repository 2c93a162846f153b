"""The number of terms of an expression after expansion, counted without expanding it."""

from __future__ import annotations

from math import comb, prod

from symbody.symbolic._core import Expr

from .reading import nodes_of

MOST = 1500
"""The largest number of terms that is counted; expressions with more terms are not expanded."""
_POWER = 20
"""Powers of sums with this exponent or a larger one count as one term."""


def number_of_terms(expression: Expr) -> int:
    """Return the number of terms of an expression after expansion, or ``MOST + 1`` if there are more than `MOST`.

    >>> from symbody import symbols
    >>> a, b, c = symbols("a b c")
    >>> number_of_terms((a + b) * (a + c) + (a + b) ** 3)
    8
    """
    counts = dict[int, int]()
    for node in nodes_of(expression):
        inner = [counts[arg.id] for arg in node.args]
        if node.kind == "sum":
            count = sum(inner)
        elif node.kind == "product":
            count = prod(inner)
        elif node.kind == "power" and node.args[1].is_number:
            top, bottom = node.args[1].ratio
            count = comb(min(inner[0], MOST) + top - 1, top) if bottom == 1 and 1 < top < _POWER else 1
        else:
            count = max(inner, default=1)
        counts[node.id] = min(count, MOST + 1)
    return counts[expression.id]
