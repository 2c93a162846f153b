"""Names as scalars."""

from __future__ import annotations

from symbody.symbolic import Expr, t
from symbody.symbolic import symbol as plain_symbol

__all__ = ["symbol"]


def symbol(name: str) -> Expr:
    """Return what a name without a value stands for: ``t`` is time, all others are symbols."""
    return t if name == "t" else plain_symbol(name)
