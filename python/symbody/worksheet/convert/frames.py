"""Frames, axes and components, as the commands of mechanics take them."""

from __future__ import annotations

from symbody.geometry import Frame, Point
from symbody.symbolic import Expr, Matrix
from symbody.worksheet.convert.operations import PRODUCT, grouped
from symbody.worksheet.convert.selections import word_of
from symbody.worksheet.convert.writer import Writer
from symbody.worksheet.sheet import syntax

__all__ = ["axis", "components", "frame"]

_AXES = {"X", "Y", "Z"}


def axis(to: Writer, node: syntax.Expression) -> str:
    """Return an axis of rotation: ``X`` as a text, unless it has a value."""
    is_word = isinstance(node, syntax.Name | syntax.Delayed)
    word = word_of(node) if is_word else ""
    known = to.names.values.get(word)
    if word in _AXES and (known is None or isinstance(known, Expr) or isinstance(node, syntax.Delayed)):
        return f'"{word}"'
    return to.text(node)


def components(to: Writer, arguments: tuple[syntax.Expression, ...]) -> str:
    """Return the components of a vector, or the coordinates of a point, also in another frame."""
    text = to.text(arguments[0])
    if len(arguments) == 2:
        text = f"sb.project({text}, {frame(to, arguments[1])})"
    found = to.value(text)
    return f"{grouped(text)}.{'coordinates' if isinstance(found, Point) else 'components'}"


def frame(to: Writer, node: syntax.Expression) -> str:
    """Return a frame as commands take it: on the moving frame, where there is one."""
    if isinstance(node, syntax.Name | syntax.Delayed) and word_of(node) == "absolute":
        return to.names.master or "sb.ground"
    text = to.text(node)
    found = to.value(text)
    if isinstance(found, Matrix):
        text, found = f"sb.Frame({text})", to.value(f"sb.Frame({text})")
    if to.names.master and isinstance(found, Frame):
        master = to.names.values[to.names.master]
        if found.ancestor.key != master.ancestor.key:
            return f"{to.names.master}*{grouped(text, PRODUCT)}"
    return text
