"""Names that are made of pieces: ``a || b``."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from symbody.worksheet import builtins
from symbody.worksheet.evaluation.session import Session, sequence
from symbody.worksheet.interpreter.leaf import named
from symbody.worksheet.sheet import syntax
from symbody.worksheet.values.value import Sequence, String, Value

__all__ = ["METHODS", "concatenation"]


def concatenation(session: Session, node: syntax.Expression) -> str:
    """Return the name that ``a || b`` makes; the left side isn't evaluated."""
    if isinstance(node, syntax.Name):
        return node.name
    if isinstance(node, syntax.Text):
        return node.text
    if isinstance(node, syntax.Concatenation):
        return concatenation(session, node.left) + _piece(session, node.right)
    return _piece(session, node)


def _concatenated(session: Session, node: syntax.Concatenation) -> Value:
    """Return what the name ``a || b`` stands for; ``a || (1..3)`` are several."""
    if isinstance(node.right, syntax.Infix | syntax.SequenceDisplay):
        right = session.evaluate(node.right)
        items = builtins.repeated(session, right)
        if isinstance(items, Sequence):
            left = concatenation(session, node.left)
            return sequence([named(session, left + _bare(session.text(item))) for item in items.items])
    return named(session, concatenation(session, node))


def _piece(session: Session, node: syntax.Expression) -> str:
    value = session.evaluate(node)
    return value.text if isinstance(value, String) else _bare(session.text(value))


def _bare(text: str) -> str:
    return text[1:-1] if text.startswith("`") and text.endswith("`") else text


METHODS: dict[type, Callable[[Session, Any], Value]] = {
    syntax.Concatenation: _concatenated,
}
