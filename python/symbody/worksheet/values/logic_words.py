"""The operators of logic, by their names."""

from __future__ import annotations

__all__ = ["LOGIC", "NEGATION"]

NEGATION = "not"
LOGIC = frozenset({"and", "or", "xor", "implies", NEGATION})
