"""Things in words, as MBSymba shows them."""

from __future__ import annotations

import sys
from collections.abc import Iterable
from typing import TypeAlias

from symbody.geometry import Frame, Point, Vector
from symbody.symbolic import Expr, Matrix

from .body import Body
from .load import Force, Torque

Shown: TypeAlias = Frame | Point | Vector | Body | Force | Torque | Expr | Matrix


def show(thing: Shown, *, synthetic: bool = False) -> None:
    """Print a thing with all its fields.

    Args:
        thing: a frame, point, vector, body, force or torque.
        synthetic: whether to print frames by their names alone.

    >>> from symbody import Point, ground, show
    >>> show(Point(ground, 1, 2, 0, name="A"))
    A = POINT(frame = ground, coords = [1, 2, 0])
    """
    sys.stdout.write(describe(thing, synthetic=synthetic) + "\n")


def describe(thing: Shown, *, synthetic: bool = False) -> str:
    """Return what `show` prints."""
    name = getattr(thing, "name", "")
    fields = _fields(thing, synthetic=synthetic)
    if not fields:
        return _frame(thing, synthetic=synthetic) if isinstance(thing, Frame) else str(thing)
    body = f"{type(thing).__name__.upper()}({', '.join(f'{field} = {value}' for field, value in fields)})"
    return f"{name} = {body}" if name else body


def _fields(thing: Shown, *, synthetic: bool) -> list[tuple[str, str]]:
    match thing:
        case Point():
            return [("frame", _frame(thing.frame, synthetic=synthetic)), ("coords", _list(thing.coordinates))]
        case Vector():
            return [("frame", _frame(thing.frame, synthetic=synthetic)), ("comps", _list(thing.components))]
        case Body():
            frame = _frame(thing.frame, synthetic=synthetic)
            return [("frame", frame), ("mass", str(thing.mass)), ("inertia", _rows(thing.inertia))]
        case Force() | Torque():
            return _load_fields(thing, synthetic=synthetic)
        case _:
            return []


def _load_fields(load: Force | Torque, *, synthetic: bool) -> list[tuple[str, str]]:
    fields = _fields(load.vector, synthetic=synthetic)
    if isinstance(load, Force):
        fields.append(("applied", load.at.name or describe(load.at, synthetic=synthetic)))
    fields.append(("acting", _body(load.on)))
    if load.reaction is not None:
        fields.append(("reacting", _body(load.reaction)))
    return fields


def _body(body: Body) -> str:
    return body.name or f"BODY(mass = {body.mass})"


def _frame(frame: Frame, *, synthetic: bool) -> str:
    if frame.parent is None or (synthetic and frame.name):
        return frame.name
    return _rows(frame.matrix)


def _rows(matrix: Matrix) -> str:
    columns = matrix.shape[1]
    entries = matrix.entries
    return _list(_list(entries[start : start + columns]) for start in range(0, len(entries), columns))


def _list(entries: Iterable[Expr | str]) -> str:
    return f"[{', '.join(str(entry) for entry in entries)}]"
