"""Names of constraints in messages: the number, with the beginning of the text."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from symbody.symbolic import Expr

__all__ = ["named_constraints", "shortened"]

_SHOWN = 80


def shortened(expression: Expr, most: int = _SHOWN) -> str:
    """Return the text of an expression, or its beginning."""
    text = str(expression)
    return text if len(text) <= most else f"{text[:most]}..."


def named_constraints(constraints: Sequence[Expr], rows: Iterable[int], most: int = _SHOWN) -> list[str]:
    """Return the names of some constraints.

    >>> from symbody import symbols
    >>> named_constraints(symbols("x y"), [1])
    ['2 (y = 0)']
    """
    return [f"{row + 1} ({shortened(constraints[row], most)} = 0)" for row in rows]
