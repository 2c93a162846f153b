"""The two modelling modes: a moving master frame, and small variables."""

from __future__ import annotations

from symbody.geometry import Frame, Point, Vector
from symbody.multibody import Body, Force, Torque
from symbody.symbolic import Expr, Matrix, small, subs
from symbody.worksheet.convert.names import NoText, identifier
from symbody.worksheet.convert.sequences import items
from symbody.worksheet.convert.writer import Writer
from symbody.worksheet.sheet import syntax

__all__ = ["mode_lines"]

_MASTER = "master"
_MARKED = Expr | Matrix | Frame | Point | Vector | Body | Force | Torque


def mode_lines(text: Writer, value: syntax.Expression) -> list[str] | None:
    """Return the lines of a statement that begins a mode; None for another one."""
    match value:
        case syntax.Call(
            function=syntax.Name(name="use_moving_frame" | "USE_master_frame"), arguments=arguments
        ):
            return _moving(text, arguments)
        case syntax.Call(function=syntax.Name(name="linear_modeling"), arguments=sets):
            return _small(text, sets)
    return None


def _moving(text: Writer, arguments: tuple[syntax.Expression, ...]) -> list[str]:
    """Return ``master = sb.moving_frame(...)``; frames hang on it when a command takes them."""
    written = items(text, arguments[:6])
    text.names.master = ""
    name = _MASTER
    while isinstance(text.names.values.get(name), Expr):
        name += "_"
    text.names.root().master = text.names.master = name
    return [f'{name} = sb.moving_frame({written}, name="moving_frame")']


def _small(text: Writer, sets: tuple[syntax.Expression, ...]) -> list[str]:
    """Return ``x, psi = sb.small(x, psi)``."""
    names: list[str] = []
    for each in sets:
        if not isinstance(each, syntax.SetDisplay | syntax.ListDisplay):
            raise NoText("linear_modeling")
        for item in each.items:
            name = text.text(item)
            plain = text.value(name)
            if not name.isidentifier() or not isinstance(plain, Expr) or not plain.is_variable:
                raise NoText("linear_modeling")
            text.names.small[small(plain)] = plain
            names.append(name)
    if not names:
        raise NoText("linear_modeling")
    listed = ", ".join(identifier(name) for name in names)
    older = _made_before(text, {plain: mark for mark, plain in text.names.small.items()})
    if not older:
        return [f"{listed} = sb.small({listed})"]
    marks = ", ".join(f"{name}: sb.small({name})" for name in map(identifier, names))
    return [
        f"marks = {{{marks}}}  # of what was made before, too",
        f"{listed} = marks.values()" if len(names) > 1 else f"({listed},) = marks.values()",
        *(f"{name} = sb.subs({name}, marks)" for name in older),
    ]


def _made_before(text: Writer, marks: dict[Expr, Expr]) -> list[str]:
    """Return the names of what holds variables that are small from now on."""
    made = {name: value for name, value in text.names.values.items() if isinstance(value, _MARKED)}
    return [name for name, value in made.items() if value not in marks and subs(value, marks) != value]
