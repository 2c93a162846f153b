"""The joint of MBSymba, and its constraint."""

from __future__ import annotations

from symbody.errors import WorksheetError
from symbody.symbolic import Expr, time_function
from symbody.worksheet.evaluation.session import Command, Session
from symbody.worksheet.mechanics import frame_face
from symbody.worksheet.mechanics.modes import mechanics
from symbody.worksheet.mechanics.objects import Reader, column, made, members, written
from symbody.worksheet.values.value import MapleSet, Reference, Sequence, String, Value

__all__ = ["COMMANDS"]


def spherical_JOINT(
    session: Session, P1: Value, P2: Value, body1: Value, body2: Value, tag: Value | None = None
) -> Value:
    """spherical_JOINT(P1, P2, b1, b2, "B"): the constraint P2 - P1 = 0, the force on b1, and its reaction on b2.

    The force has the components FxB(t), FyB(t), FzB(t) in the axes of the ground; it acts on body 1 at P1, and the
    opposite force on body 2 at P2. The constraint is a vector.

    Args:
        session: the session.
        P1: the point of the joint on body 1.
        P2: that on body 2.
        body1: the body on which the force acts.
        body2: the body on which the opposite force acts.
        tag: what ends the names of the components.
    """
    reader = Reader(session, "spherical_JOINT")
    gap = (reader.point(P2) - reader.point(P1)).projected(reader.root).components
    name = tag.text if isinstance(tag, String) else "" if tag is None else str(getattr(tag, "name", tag))
    force = [session.current(time_function(f"F{axis}{name}")) for axis in "xyz"]
    if not all(isinstance(each, Expr) for each in force):
        raise WorksheetError(
            f"spherical_JOINT: the names Fx{name}, Fy{name}, Fz{name} hold more than expressions"
        )
    components = [each for each in force if isinstance(each, Expr)]
    modes = mechanics(session)
    frame = frame_face.ground_face(modes)
    acting = made("FORCE", frame=frame, acting=body1, comps=column(components, 0, modes), applied=P1)
    opposite = [-each for each in components]
    reacting = made("FORCE", frame=frame, acting=body2, comps=column(opposite, 0, modes), applied=P2)
    return Sequence((written(session, "VECTOR", gap, frame), acting, reacting))


def make_CONSTRAINT(session: Session, expressions: Value) -> Value:
    """make_CONSTRAINT([phi, ...]): a constraint by expressions that are zero."""
    items = members(
        session, session.current(expressions) if not isinstance(expressions, Reference) else expressions
    )
    return made("CONSTRAINT", expr=MapleSet(tuple(dict.fromkeys(items))))


COMMANDS: dict[str, Command] = {"spherical_JOINT": spherical_JOINT, "make_CONSTRAINT": make_CONSTRAINT}
