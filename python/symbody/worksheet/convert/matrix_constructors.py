"""Matrices and vectors by their entries, with the options of Maple."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TypeAlias

from symbody.symbolic import Matrix
from symbody.worksheet.convert.names import NoText
from symbody.worksheet.convert.writer import Arguments, Writer
from symbody.worksheet.sheet import syntax

__all__ = ["CONSTRUCTORS"]

Call: TypeAlias = Callable[[Writer, Arguments], str]


def _matrix(text: Writer, arguments: Arguments) -> str:
    """Return a matrix of rows, or of a list of entries."""
    arguments, shape, fill = _matrix_options(text, arguments)
    if shape == "identity":
        return f"sb.identity({text.text(arguments[0])})"
    if fill:
        height, width = (text.text(arguments[k]) for k in (0, -1))
        return f"sb.Matrix([[{fill}]*{width}]*{height})"
    if len(arguments) > 1 and (entry := _of_indices(arguments[-1], 2)) is not None:
        body, (row, column) = entry
        sizes = (arguments[0], arguments[-2])
        line = syntax.ListDisplay((_sequence(body, column, sizes[1]),), place=body.place)
        return (
            f"sb.Matrix({text.text(syntax.ListDisplay((_sequence(line, row, sizes[0]),), place=body.place))})"
        )
    counts = [text.text(each) for each in arguments[:2]]
    if len(arguments) == 3 and all(each.isdigit() for each in counts):
        rows, columns = map(int, counts)
        content = text.text(arguments[2])
        found = text.value(content)
        if isinstance(found, list) and len(found) == rows * columns and rows * columns != rows:
            return f"sb.Matrix.from_entries({rows}, {columns}, {content})"
        if isinstance(found, list):
            return f"sb.Matrix({content})"
    if len(arguments) <= 2 and all(_is_count(text, each) for each in counts):
        return f"sb.zeros({counts[0]}, {counts[-1]})"
    if len(arguments) == 1:
        found = text.value(counts[0])
        if isinstance(found, Matrix):
            return counts[0]
        if isinstance(found, list) and all(isinstance(each, list) for each in found):
            return f"sb.Matrix({counts[0]})"
    raise NoText("Matrix")


def _is_count(text: Writer, written: str) -> bool:
    found = text.value(written)
    return isinstance(found, int) and not isinstance(found, bool)


def _matrix_options(text: Writer, arguments: Arguments) -> tuple[Arguments, str, str]:
    """Return the arguments of a matrix without its options, the shape, and what fills it."""
    kept, shape, fill = [], "", ""
    for argument in arguments:
        match argument:
            case syntax.Infix(operator="=", left=syntax.Name(name="shape"), right=syntax.Name(name=name)):
                shape = name
            case syntax.Infix(operator="=", left=syntax.Name(name="fill"), right=value):
                fill = text.text(value)
            case syntax.Infix(operator="=", left=syntax.Name(name="attributes" | "datatype" | "storage")):
                pass
            case _:
                kept.append(argument)
    return tuple(kept), shape, fill


def _of_indices(
    node: syntax.Expression, count: int
) -> tuple[syntax.Expression, tuple[syntax.Parameter, ...]] | None:
    """Return the body and the indices of ``(i, j) -> e``; None for other content."""
    match node:
        case syntax.Arrow(parameters=parameters, body=body) if len(parameters) == count:
            return None if isinstance(body, syntax.If) else (body, parameters)
    return None


def _sequence(each: syntax.Expression, index: syntax.Parameter, last: syntax.Expression) -> syntax.Expression:
    """Return ``seq(each, index = 1 .. last)``."""
    place = each.place
    span = syntax.Infix("..", syntax.Integer(1, place=place), last, place=place)
    over = syntax.Infix("=", syntax.Name(index.name, place=place), span, place=place)
    return syntax.Call(syntax.Name("seq", place=place), (each, over), place=place)


def _column(text: Writer, arguments: Arguments) -> str:
    if len(arguments) == 2 and (entry := _of_indices(arguments[1], 1)) is not None:
        body, (index,) = entry
        made = syntax.ListDisplay((_sequence(body, index, arguments[0]),), place=body.place)
        return f"sb.Matrix.column({text.text(made)})"
    content = text.text(arguments[-1])
    if len(arguments) == 1 and _is_count(text, content):
        return f"sb.zeros({content}, 1)"
    if not isinstance(text.value(content), list):
        raise NoText("Vector")
    return f"sb.Matrix.column({content})"


def _array(text: Writer, arguments: Arguments) -> str:
    """Return an array of the old kind: a vector of one list or size, a matrix of several."""
    sizes = [last for each in arguments if (last := _last(each)) is not None]
    content = tuple(each for each in arguments if _last(each) is None)
    if len(sizes) > 2 or len(content) > 1:
        raise NoText("array")
    found = text.value(text.text(content[0])) if content else None
    is_vector = len(sizes) == 1 or (
        isinstance(found, list) and bool(found) and not isinstance(found[0], list)
    )
    return (_column if is_vector else _matrix)(text, content or tuple(sizes))


def _last(node: syntax.Expression) -> syntax.Expression | None:
    """Return n of the bounds ``1 .. n``; None for other arguments."""
    match node:
        case syntax.Infix(operator="..", left=syntax.Integer(value=1), right=last):
            return last
    return None


CONSTRUCTORS: Mapping[str, Call] = {
    "array": _array,
    **dict.fromkeys(("Matrix", "matrix"), _matrix),
    **dict.fromkeys(("Vector", "vector"), _column),
}
"""Writers by the names of commands."""
