"""Objects made from what ``show`` returns in a session, ``VECTOR(frame = .., comps = ..)``."""

from __future__ import annotations

from typing import Any

from symbody.geometry import Point, Vector, ground, origin
from symbody.multibody import Body, Force, Torque
from symbody.symbolic import Expr, symbol
from symbody.worksheet.evaluation.session import Session
from symbody.worksheet.values.value import Reference, Relation, Table, Unevaluated, Value

__all__ = ["shown_object", "without_frame"]

_KINDS = {"POINT": "POINT", "VECTOR": "VECTOR", "BODY": "BODY", "FORCE": "VECTOR", "TORQUE": "VECTOR"}
"""The type of which an object is compared: a load is compared as a vector, because its bodies may be mere names."""


def shown_object(session: Session, shown: Unevaluated) -> tuple[Table | None, bool]:
    """Return the object whose fields are shown, and whether its frame is known; None if no object is shown.

    A frame that is shown by its name is the frame of the session; ``show`` may have made the name up.
    """
    kind = _KINDS.get(getattr(shown.function, "name", ""))
    if kind is None:
        return None, False
    fields = {each.left: each.right for each in shown.arguments if isinstance(each, Relation)}
    place, is_known = symbol("frame"), True
    frame = fields.get(place)
    if isinstance(frame, Expr):
        del fields[place]  # an object without this field is on the ground
        if frame.name in session.names:
            fields[place] = Reference(frame.name)
        else:
            is_known = frame == symbol("ground")
    entries: dict[tuple[Value, ...], Value] = {(name,): value for name, value in fields.items()}
    return Table({**entries, (symbol("obj"),): symbol(kind)}), is_known


def without_frame(made: Any) -> Any:
    """Return an object on the ground with the same coordinates, components, or mass and inertia."""
    match made:
        case Point():
            return Point(ground, *made.coordinates)
        case Vector() | Force() | Torque():
            return Vector(ground, *made.components)
        case Body():
            return Body.of_inertia(origin(ground), made.mass, made.inertia)
    return made
