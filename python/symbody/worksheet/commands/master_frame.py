"""The moving master frame: a mode in which every frame counts from a frame with velocities in its own axes."""

from __future__ import annotations

from symbody.errors import WorksheetError
from symbody.geometry import Frame, angular_velocity, ground, origin, velocity
from symbody.symbolic import Expr, number
from symbody.worksheet.evaluation.session import Command, Session
from symbody.worksheet.mechanics import frame_face
from symbody.worksheet.mechanics.modes import Mechanics, mechanics
from symbody.worksheet.mechanics.objects import column, made
from symbody.worksheet.mechanics.small_variables import entered, entered_frame, left, moving_master
from symbody.worksheet.values.value import NULL, Array, Boolean, Listed, Relation, Value

__all__ = ["COMMANDS", "name_ground", "use_moving_frame"]

Triple = tuple[Expr, Expr, Expr]


def use_moving_frame(session: Session, *arguments: Value) -> Value:
    """use_moving_frame(u, v, w, ox, oy, oz [, T]): all frames count from a frame that moves so, from now on.

    Velocities and angular velocities are along the axes of the frame. With its absolute pose T, the value is the list
    of tracking equations: the velocities of T along its own axes are the given ones.
    """
    modes = mechanics(session)
    if not 6 <= len(arguments) <= 7:
        raise WorksheetError(
            "use_moving_frame: expected six velocities u, v, w, ox, oy, oz, and at most a pose"
        )
    found = [session.current(each) for each in arguments[:6]]
    if not all(isinstance(each, Expr) for each in found):
        raise WorksheetError("use_moving_frame: expected six expressions u, v, w, ox, oy, oz")
    u, v, w, wx, wy, wz = (each for each in found if isinstance(each, Expr))
    pose = frame_face.chain(session, arguments[6], "use_moving_frame") if len(arguments) > 6 else None
    modes.speeds = (u, v, w, wx, wy, wz)
    modes.moving = moving_master(modes)
    name_ground(session)
    _set_globals(session, modes, (u, v, w), (wx, wy, wz))
    return NULL if pose is None else _tracking(modes, pose, (u, v, w), (wx, wy, wz))


def name_ground(session: Session) -> None:
    """Set the names of the frame from which all others count, as the mode has it."""
    face = frame_face.ground_face(mechanics(session))
    for name in frame_face.GROUNDS:
        session.assign(name, face)


def _set_globals(session: Session, modes: Mechanics, linear: Triple, angular: Triple) -> None:
    (u, v, w), (x, y, z), zero = linear, angular, number(0)
    rows = [zero, -z, y, u, z, zero, -x, v, -y, x, zero, w, zero, zero, zero, zero]
    matrix = Array(4, 4, list(left(modes, entered(modes, rows))), modes.matrix_kind)
    spin = made("VECTOR", frame=frame_face.ground_face(modes), comps=column(angular, 0, modes))
    session.assign("VM", matrix)
    session.assign("omegaMV", spin)
    session.assign("mframe_flag", Boolean(True))
    session.lines.append("Warning, The base frame <moving_frame> has been selected.")
    if modes.release < 6:
        session.lines += ["The moving velocity matrix is:", session.text(matrix)]


def _tracking(modes: Mechanics, pose: Frame, linear: Triple, angular: Triple) -> Listed:
    """Return the equations of the velocities of a pose along its own axes; those without rates are left out."""
    frame = entered_frame(modes, pose)
    moving = velocity(origin(frame), ground).projected(frame)
    own = (*moving.components, *angular_velocity(frame).components)
    sides = zip(left(modes, own), (*linear, *angular), strict=True)
    equations = tuple(Relation("=", rate, given) for rate, given in sides if not rate.is_constant)
    return Listed(equations)


COMMANDS: dict[str, Command] = {"use_moving_frame": use_moving_frame, "USE_master_frame": use_moving_frame}
