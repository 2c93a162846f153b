"""Commands that make and move frames."""

from __future__ import annotations

from typing import TYPE_CHECKING

from symbody.deferred import Deferred
from symbody.errors import WorksheetError
from symbody.geometry import Frame
from symbody.geometry import rotate as rotated
from symbody.geometry import translate as translated
from symbody.symbolic import Expr, dot3, sqrt, symbol
from symbody.worksheet.drawing.moved import rotated_drawing, translated_drawing
from symbody.worksheet.evaluation.session import Command, Session
from symbody.worksheet.mechanics import frame_face
from symbody.worksheet.mechanics.modes import mechanics
from symbody.worksheet.mechanics.objects import Reader, face_of, fields_of, kind_of, members, put, written
from symbody.worksheet.mechanics.small_variables import entered_frame
from symbody.worksheet.values.value import NULL, Array, Plot, Sequence, String, Table, Value

if TYPE_CHECKING:
    from symbody import multibody
else:
    multibody = Deferred("symbody.multibody")

__all__ = ["COMMANDS", "copied", "rotate", "translate"]


def translate(session: Session, *arguments: Value) -> Value:
    """translate(x, y, z): the frame displaced by x, y, z; translate(x, y, z, obj): an object displaced so.

    A drawing as the first argument is displaced as by plottools.
    """
    if arguments and isinstance(drawing := session.resolve(arguments[0]), Plot):
        return translated_drawing(session, drawing, arguments[1:])
    items, things = _split(session, arguments, 3)
    reader = Reader(session, "translate")
    motion = translated(*_plain(reader, items))
    return _moved(reader, motion, things)


def rotate(session: Session, *arguments: Value) -> Value:
    """rotate(axis, angle): the frame rotated about 'X', 'Y', 'Z' or a VECTOR; rotate(axis, angle, obj).

    A drawing as the first argument is turned as by plottools.
    """
    if arguments and isinstance(drawing := session.resolve(arguments[0]), Plot):
        return rotated_drawing(session, drawing, arguments[1:])
    reader = Reader(session, "rotate")
    if len(arguments) < 2:
        raise WorksheetError("rotate: expected an axis ('X', 'Y', 'Z' or a VECTOR) and an angle")
    axis, angle, *things = arguments
    turn = session.current(angle)
    if not isinstance(turn, Expr):
        raise WorksheetError("rotate: the angle is no expression")
    return _moved(reader, rotated(_axis(reader, axis), turn), things)


def _plain(reader: Reader, items: tuple[Value, ...]) -> tuple[Expr, Expr, Expr]:
    """Return three expressions as the sheet has them: chains are kept without modes."""
    found = [reader.session.current(item) for item in items]
    if len(found) != 3 or not all(isinstance(each, Expr) for each in found):
        raise WorksheetError(f"{reader.where}: expected three expressions x, y, z")
    x, y, z = (each for each in found if isinstance(each, Expr))
    return x, y, z


def _split(
    session: Session, arguments: tuple[Value, ...], count: int
) -> tuple[tuple[Value, ...], tuple[Value, ...]]:
    """Return the first arguments, which may be one list or column, and the others."""
    if arguments and not isinstance(session.resolve(arguments[0]), Expr):
        first = session.resolve(arguments[0])
        items = tuple(first.entries[:count]) if isinstance(first, Array) else members(session, first)
        return items, arguments[1:]
    return arguments[:count], arguments[count:]


def _axis(reader: Reader, axis: Value) -> str | tuple[Expr, Expr, Expr]:
    if isinstance(axis, String):
        return axis.text
    if isinstance(axis, Expr):
        if axis.kind == "symbol" and axis.name.upper() in {"X", "Y", "Z"}:
            return axis.name.upper()
        raise WorksheetError(f"rotate: the axis {axis}; expected 'X', 'Y', 'Z' or a VECTOR")
    components = reader.vector(axis).components
    length = sqrt(dot3(components, components))
    x, y, z = components if length == 1 else (each / length for each in components)
    return x, y, z


def _moved(reader: Reader, motion: Frame, things: tuple[Value, ...] | list[Value]) -> Value:
    """Return the motion as a frame, or the objects after it."""
    session = reader.session
    if not things:
        return frame_face.face(mechanics(session), motion)
    found = tuple(_displaced(reader, motion, thing) for thing in things)
    return found[0] if len(found) == 1 else Sequence(found)


def _displaced(reader: Reader, motion: Frame, thing: Value) -> Value:
    session = reader.session
    table = session.resolve(thing)
    if not isinstance(table, Table):
        return frame_face.face(mechanics(session), reader.chain(thing) * motion)
    kind, frame = kind_of(table), reader.frame_value(table)
    own, moving = reader.frame(table), entered_frame(mechanics(session), motion)
    if kind == "POINT":
        point = multibody.displaced(reader.point(table), moving).projected(own)
        return written(session, kind, point.coordinates, frame)
    if kind == "BODY":
        found = copied(table)
        put(found, "frame", face_of(session, own * moving))
        return found
    vector = multibody.displaced(reader.vector(table), moving).projected(own)
    fields = fields_of(table, "acting", "reacting")
    if kind == "FORCE":
        at = multibody.displaced(
            reader.point(fields_of(table, "applied")["applied"] or table), moving, frame=own
        )
        fields["applied"] = written(session, "POINT", at.projected(own).coordinates, frame)
    return written(session, kind, vector.components, frame, **fields)


def copied(table: Table) -> Table:
    """Return a copy of a table, with copies of the matrices in it."""
    return Table({key: _copy(value) for key, value in table.entries.items()})


def _copy(value: Value) -> Value:
    if not isinstance(value, Array) or isinstance(value.frame, Frame):
        return value
    return Array(value.rows, value.columns, list(value.entries), value.kind, value.attributes)


def inv_frame(session: Session, frame: Value) -> Value:
    """inv_frame(T): the inverse of a frame; by the transpose, if its axes aren't known to be orthonormal."""
    return frame_face.face(mechanics(session), Reader(session, "inv_frame").chain(frame).inverse())


def set_frame_name(session: Session, frame: Value, name: Value) -> Value:
    """set_frame_name(T, 'name'): gives a matrix the name by which show prints it."""
    array = session.resolve(Reader(session, "set_frame_name").frame_value(frame))
    if not frame_face.is_frame(array) or not isinstance(array, Array):
        raise WorksheetError("set_frame_name: expected a frame and a name, such as set_frame_name(T, 'T__1')")
    array.attributes = (symbol(name.text) if isinstance(name, String) else name,)
    return NULL


COMMANDS: dict[str, Command] = {
    "translate": translate,
    "Translate": translate,
    "rotate": rotate,
    "Rotate": rotate,
    "inv_frame": inv_frame,
    "set_frame_name": set_frame_name,
}
