"""Frames, points, vectors, bodies and loads of a session as calls that make them."""

from __future__ import annotations

from symbody.geometry import Frame, Point, ground
from symbody.multibody import Body, Force, Torque
from symbody.symbolic import identity
from symbody.worksheet.convert.names import Names, NoText
from symbody.worksheet.convert.scalar_text import scalar_text
from symbody.worksheet.evaluation.session import Session
from symbody.worksheet.mechanics.objects import Reader, kind_of
from symbody.worksheet.values.value import Table

__all__ = ["known_frame", "load_text", "object_text"]


def object_text(session: Session, value: Table, names: Names) -> str:
    """Return a point, a vector or a body, in a frame that the program has, if it has it."""
    reader, kind = Reader(session, "convert"), kind_of(value)
    if kind == "BODY":
        body = reader.body(value)
        rows = (", ".join(scalar_text(body.inertia[i, j], names) for j in range(3)) for i in range(3))
        place, mass = f"sb.origin({_frame(body.frame, names)})", scalar_text(body.mass, names)
        return f"sb.Body.of_inertia({place}, {mass}, sb.Matrix([{', '.join(f'[{row}]' for row in rows)}]))"
    thing = reader.point(value) if kind == "POINT" else reader.vector(value)
    entries = thing.coordinates if isinstance(thing, Point) else thing.components
    texts = [_frame(thing.frame, names), *(scalar_text(entry, names) for entry in entries)]
    return f"sb.{str(kind).capitalize()}({', '.join(texts)})"


def load_text(session: Session, value: Table, names: Names) -> str:
    """Return a force or a torque on bodies that the program has.

    Raises:
        NoText: it has not all of them.
    """
    load = Reader(session, "convert").load(value)
    if not isinstance(load, Force | Torque):
        raise NoText("load")
    what = [_frame(load.frame, names), *(scalar_text(each, names) for each in load.components)]
    if isinstance(load, Force):
        place = [_frame(load.at.frame, names), *(scalar_text(each, names) for each in load.at.coordinates)]
        what.append(f"at=sb.Point({', '.join(place)})")
    what.append(f"on={_body_name(load.on, names)}")
    if load.reaction is not None:
        what.append(f"reaction={_body_name(load.reaction, names)}")
    return f"sb.{type(load).__name__}({', '.join(what)})"


def _body_name(body: Body, names: Names) -> str:
    """Return the variable of the program that holds a body."""
    for name, made in names.values.items():
        if isinstance(made, Body) and made.mass == body.mass and made.frame.matrix == body.frame.matrix:
            return name
    raise NoText("body")


def _frame(frame: Frame, names: Names) -> str:
    known = known_frame(frame, names)
    if known:
        return known
    matrix = frame.matrix
    rows = (", ".join(scalar_text(matrix[i, j], names) for j in range(4)) for i in range(4))
    made = f"sb.Frame([{', '.join(f'[{row}]' for row in rows)}])"
    return f"{names.master}*{made}" if names.master else made


def known_frame(frame: Frame, names: Names) -> str:
    """Return the name of a frame that the program has; nothing if it has none."""
    matrix, on = frame.matrix, f"{names.master}*" if names.master and frame.ancestor.key != ground.key else ""
    if matrix == identity(4):
        return names.master if on else "sb.ground"
    for name, made in names.values.items():
        if isinstance(made, Frame) and made.matrix == matrix and name != "last":
            return f"{on}{name}" if on and made.ancestor.key == ground.key else name
    return ""
