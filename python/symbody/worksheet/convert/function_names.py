"""Functions of time that commands name, such as the force ``FxB`` of a joint and the speed ``x[dot]``."""

from __future__ import annotations

from symbody.symbolic import Expr
from symbody.worksheet.convert.names import identifier
from symbody.worksheet.convert.writer import Writer
from symbody.worksheet.sheet import syntax

__all__ = ["function_of_time"]


def function_of_time(text: Writer, name: str, place: syntax.Place) -> str:
    """Return a function of time, or the value that the sheet has given it."""
    known = text.names.values.get(identifier(name))
    if known is not None and not isinstance(known, Expr):
        return identifier(name)
    text.names.functions.add(name)
    time = syntax.Name("t", place=place)
    return text.text(syntax.Call(syntax.Name(name, place=place), (time,), place=place))
