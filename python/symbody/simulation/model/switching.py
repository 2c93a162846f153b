"""The functions of time and state at whose zeros expressions may jump."""

from __future__ import annotations

from collections.abc import Collection, Sequence

from symbody.symbolic import Expr, free_symbols
from symbody.symbolic.expression.traverse import post_order

__all__ = ["switching_functions"]


def switching_functions(expressions: Sequence[Expr], variables: Collection[Expr]) -> tuple[Expr, ...]:
    """Return the arguments of signs and the conditions of branches that contain some of the variables.

    `Abs`, `Min` and `Max` have kinks, and no jumps.

    >>> from symbody import Piecewise, sign, symbols, t
    >>> x, v, F = symbols("x v F")
    >>> switching_functions([F * sign(v) + Piecewise((F, x), (0, t - 1))], {x, v})
    (v, x)
    """
    found: dict[Expr, None] = {}
    for node in post_order(expressions, lambda node: node.args, lambda node: node.id):
        if node.kind != "function" or node.name not in {"sign", "Piecewise"}:
            continue
        functions = node.args if node.name == "sign" else node.args[1::2]
        found |= dict.fromkeys(g for g in functions if not free_symbols([g]).isdisjoint(variables))
    return tuple(sorted(found, key=str))
