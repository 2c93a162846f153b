"""Shapes that are drawn: lists of points; pictures are lists of shapes, and animations are lists of pictures."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TypeAlias

import numpy as np

from symbody.symbolic import Expr
from symbody.worksheet.convert.names import NoText
from symbody.worksheet.convert.operations import grouped
from symbody.worksheet.convert.writer import Arguments, Writer
from symbody.worksheet.sheet import syntax

__all__ = ["SHAPES", "is_animated", "picture_of", "points_of", "shown_picture"]

Call: TypeAlias = Callable[[Writer, Arguments], str]

_POINT, _SHAPE, _PICTURE, _FRAMES = 1, 2, 3, 4
"""How deeply lists of numbers are nested."""


def _depth(value: object) -> int | None:
    """Return how deeply lists of constants are nested; None for something else."""
    if isinstance(value, Expr):
        return 0 if value.is_constant else None
    if isinstance(value, int | float | np.number):
        return 0
    if isinstance(value, list | tuple | np.ndarray):
        found = {_depth(each) for each in value}
        (depth,) = found if len(found) == 1 else (None,)
        return None if depth is None else depth + 1
    return None


def _of_depth(text: Writer, node: syntax.Expression, depth: int, what: str) -> str:
    """Return the text of nested lists.

    Raises:
        NoText: the lists have another depth.
    """
    written = text.text(node)
    if _depth(text.value(written)) != depth:
        raise NoText(what)
    return written


def _point(text: Writer, node: syntax.Expression) -> str:
    return _of_depth(text, node, _POINT, "point")


def _line(text: Writer, arguments: Arguments) -> str:
    if len(arguments) > 1 and not isinstance(arguments[1], syntax.Infix):
        return f"[{_point(text, arguments[0])}, {_point(text, arguments[1])}]"
    return points_of(text, arguments[0])


def points_of(text: Writer, node: syntax.Expression) -> str:
    """Return a list of points."""
    return _of_depth(text, node, _SHAPE, "points")


def _closed(text: Writer, arguments: Arguments) -> str:
    points = points_of(text, arguments[0])
    return f"[*{grouped(points)}, {grouped(points)}[0]]"


def _circle(text: Writer, arguments: Arguments) -> str:
    center = _point(text, arguments[0])
    if len(text.value(center)) != 2:
        raise NoText("circle")
    has_radius = len(arguments) > 1 and not isinstance(arguments[1], syntax.Infix)
    return f"circle({center}{f', {text.text(arguments[1])}' if has_radius else ''})"


def _rectangle(text: Writer, arguments: Arguments) -> str:
    return f"rectangle({_point(text, arguments[0])}, {_point(text, arguments[1])})"


def _dot(text: Writer, arguments: Arguments) -> str:
    return f"[{_point(text, arguments[0])}]"


def picture_of(text: Writer, written: list[str]) -> str:
    """Return shapes and pictures, by their texts, as one picture.

    Raises:
        NoText: something else is among them.
    """
    parts = []
    for each in written:
        value = text.value(each)
        if _depth(value) == _SHAPE:
            parts.append(each)
        elif _depth(value) == _PICTURE:
            parts.append(f"*{grouped(each)}")
        elif _depth(value) == _FRAMES:
            parts.append(f"*[shape for picture in {grouped(each)} for shape in picture]")
        elif isinstance(value, list) and all(hasattr(line, "get_xydata") for line in value):
            parts.append(f"*[line.get_xydata() for line in {grouped(each)}]")
        else:
            raise NoText("display")
    if len(written) == 1 and parts == [f"*{grouped(written[0])}"]:
        return written[0]
    return f"[{', '.join(parts)}]"


def is_animated(arguments: Arguments) -> bool:
    """Whether pictures are shown one after the other: ``insequence = true``."""
    return any(
        isinstance(each, syntax.Infix)
        and isinstance(each.left, syntax.Name)
        and each.left.name == "insequence"
        and getattr(each.right, "name", "") == "true"
        for each in arguments
    )


def shown_picture(text: Writer, written: str) -> str:
    """Return what shows a picture or an animation that has a text; other texts as they are."""
    depth = _depth(text.value(written))
    if depth == _FRAMES:
        return f"{text.names.own('animation')} = animate({written})"  # without a name, Matplotlib forgets it
    if depth in (_SHAPE, _PICTURE):
        return f"draw({written if depth == _PICTURE else f'[{written}]'})"
    return written


SHAPES: Mapping[str, Call] = {
    "line": _line,
    "curve": _line,
    **dict.fromkeys(("polygon", "polygonplot"), _closed),
    **dict.fromkeys(("circle", "disk"), _circle),
    "rectangle": _rectangle,
    "point": _dot,
}
"""Writers by the names of commands."""
