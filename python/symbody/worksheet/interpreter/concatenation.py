"""Names that are made of pieces: ``a || b``."""

from __future__ import annotations

import functools
from collections.abc import Callable
from typing import Any

from symbody.worksheet import builtins
from symbody.worksheet.evaluation.session import Session, sequence
from symbody.worksheet.interpreter.leaf import named
from symbody.worksheet.sheet import syntax
from symbody.worksheet.values.value import Sequence, String, Value

__all__ = ["METHODS", "concatenation", "names_of"]


def concatenation(session: Session, node: syntax.Expression) -> str:
    """Return the name that ``a || b`` makes; the left side isn't evaluated."""
    return ", ".join(_texts(session, node))


def names_of(session: Session, node: syntax.Concatenation) -> list[str]:
    """Return the names that ``a || (1..3)`` makes."""
    return _texts(session, node)


def _concatenated(session: Session, node: syntax.Concatenation) -> Value:
    """Return the value of the name ``a || b``; ``a || (1..3)`` gives several. If a is a string, they are strings."""
    made = String if _is_of_string(node) else functools.partial(named, session)
    return sequence([made(text) for text in _texts(session, node)])


def _texts(session: Session, node: syntax.Expression) -> list[str]:
    """Return the names that ``a || b`` makes, one for each item of b."""
    match node:
        case syntax.Name(name=name):
            return [name]
        case syntax.Text(text=text):
            return [text]
        case syntax.Concatenation(left=left, right=right):
            pieces = _pieces(session, right)
            return [before + piece for before in _texts(session, left) for piece in pieces]
    return _pieces(session, node)


def _is_of_string(node: syntax.Expression) -> bool:
    """Whether a concatenation begins with a string: ``"case" || i``."""
    while isinstance(node, syntax.Concatenation):
        node = node.left
    return isinstance(node, syntax.Text)


def _pieces(session: Session, node: syntax.Expression) -> list[str]:
    value = session.evaluate(node)
    several = isinstance(node, syntax.Infix | syntax.SequenceDisplay)
    items = builtins.repeated(session, value) if several else value
    values = items.items if several and isinstance(items, Sequence) else (items,)
    return [each.text if isinstance(each, String) else _bare(session.text(each)) for each in values]


def _bare(text: str) -> str:
    return text[1:-1] if text.startswith("`") and text.endswith("`") else text


METHODS: dict[type, Callable[[Session, Any], Value]] = {
    syntax.Concatenation: _concatenated,
}
