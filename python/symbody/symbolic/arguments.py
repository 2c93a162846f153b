"""What functions accept besides expressions, and what they say to anything else."""

from __future__ import annotations

from symbody.errors import ArgumentError
from symbody.symbolic import _core
from symbody.symbolic._core import Expr

__all__ = ["described", "expression", "size"]


_SHOWN = 80
"""Characters of an argument that a message quotes."""


def described(value: object) -> str:
    """Return what was found in words: ``3 is an int``; of a long thing only the beginning."""
    shown, kind = repr(value), type(value).__name__
    if len(shown) > _SHOWN:
        shown = f"{shown[:_SHOWN]}..."
    article = "an" if kind[0] in "aeiouAEIOU" else "a"
    return shown if value is None else f"{shown} is {article} {kind}"


def size(value: int, place: str, what: str) -> int:
    """Return a number of rows, of derivatives: a whole number, not negative."""
    if isinstance(value, bool) or not hasattr(value, "__index__") or value.__index__() < 0:
        raise ArgumentError(f"{place} is {value!r}; expected 0, 1, 2, ... {what}")
    return value.__index__()


def expression(value: object, place: str) -> Expr:
    """Return the expression of a number or an expression; ``place`` names the argument in the error."""
    return _core.number(value, place)
