"""Objects as text, in the notation of MBSymba."""

from __future__ import annotations

import sys
from collections.abc import Iterable, Mapping
from typing import Annotated, Protocol, TypeAlias, runtime_checkable

from symbody.errors import ModelError
from symbody.geometry import Frame, Point, Vector
from symbody.geometry.given.argument import checked
from symbody.symbolic import Expr, Matrix

from .body import Body
from .load import Action, Load
from .system import System


@runtime_checkable
class Described(Protocol):
    """A thing that describes itself, such as equations of motion."""

    def description(self) -> str: ...


Shown: TypeAlias = Annotated[
    Frame | Point | Vector | Body | Load | System | Described | Expr | Matrix,
    "a frame, point, vector, body, load, system, equations of motion, an expression or a matrix",
]


@checked(ModelError)
def show(thing: Shown, *, synthetic: bool = False) -> None:
    """Print an object with all its fields.

    Args:
        thing: a frame, point, vector, body, load, system, equations of motion, or an expression.
        synthetic: whether to print frames by their names alone.

    >>> from symbody import Point, ground, show
    >>> show(Point(ground, 1, 2, 0, name="A"))
    A = POINT(frame = ground, coords = [1, 2, 0])
    """
    sys.stdout.write(describe(thing, synthetic=synthetic) + "\n")


@checked(ModelError)
def describe(thing: Shown, *, synthetic: bool = False) -> str:
    """Return what `show` prints.

    Args:
        thing: a frame, point, vector, body, load, system, equations of motion, or an expression.
        synthetic: whether to show frames by their names alone.

    >>> from symbody import Vector, describe, ground
    >>> describe(Vector(ground, 1, 2, 0, name="v"))
    'v = VECTOR(frame = ground, comps = [1, 2, 0])'
    """
    if isinstance(thing, Described):
        return thing.description()
    if isinstance(thing, System):
        return _system(thing, synthetic=synthetic)
    name = getattr(thing, "name", "")
    fields = _fields(thing, synthetic=synthetic)
    if not fields:
        return _frame(thing, synthetic=synthetic) if isinstance(thing, Frame) else str(thing)
    body = _record(type(thing).__name__, fields)
    return f"{name} = {body}" if name else body


def _record(kind: str, fields: Iterable[tuple[str, str]]) -> str:
    return f"{kind.upper()}({', '.join(f'{field} = {value}' for field, value in fields)})"


def _fields(thing: Shown, *, synthetic: bool) -> list[tuple[str, str]]:
    match thing:
        case Point():
            return [("frame", _frame(thing.frame, synthetic=synthetic)), ("coords", _list(thing.coordinates))]
        case Vector():
            return [("frame", _frame(thing.frame, synthetic=synthetic)), ("comps", _list(thing.components))]
        case Body():
            frame = _frame(thing.frame, synthetic=synthetic)
            return [("frame", frame), ("mass", str(thing.mass)), ("inertia", _rows(thing.inertia))]
        case Load():
            return _values(thing.fields, synthetic=synthetic)
        case _:
            return []


def _values(fields: Mapping[str, object], *, synthetic: bool) -> list[tuple[str, str]]:
    return [(field, _value(value, synthetic=synthetic)) for field, value in fields.items()]


def _value(value: object, *, synthetic: bool) -> str:
    """Return a field of a load as text."""
    match value:
        case Frame():
            return _frame(value, synthetic=synthetic)
        case Point():
            return value.name or describe(value, synthetic=synthetic)
        case Body():
            return _body(value)
        case Action():
            kind = "force" if value.is_force else "torque"
            return _record(kind, _values(value.fields, synthetic=synthetic))
        case tuple():
            return _list(_value(entry, synthetic=synthetic) for entry in value)
        case _:
            return str(value)


def _system(system: System, *, synthetic: bool) -> str:
    """Return one line for each part of a system."""
    lines = ["SYSTEM" if not system.name else f"{system.name} = SYSTEM"]
    lines.append(f"coordinates: {', '.join(map(str, system.coordinates))}")
    if system.quasi_velocities:
        lines.append(f"quasi-velocities: {', '.join(map(str, system.quasi_velocities))}")
    lines += [f"body: {describe(body, synthetic=synthetic)}" for body in system.bodies]
    lines += [f"load: {describe(load, synthetic=synthetic)}" for load in system.loads]
    if system.gravity is not None:
        lines.append(f"gravity: {describe(system.gravity, synthetic=synthetic)}")
    for multiplier, constraint in zip(system.multipliers, system.constraints, strict=True):
        lines.append(f"constraint: {constraint} = 0, multiplier {multiplier}")
    return "\n    ".join(lines)


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
