"""The two modelling modes: a moving master frame, and small variables."""

from __future__ import annotations

from symbody.geometry import Frame, Vector, ground
from symbody.worksheet.convert.sequences import items
from symbody.worksheet.convert.small_variables import small_lines
from symbody.worksheet.convert.writer import Writer
from symbody.worksheet.sheet import syntax

__all__ = ["mode_lines"]


def mode_lines(text: Writer, value: syntax.Expression, target: str = "") -> list[str] | None:
    """Return the lines of a statement that begins a mode; None for another one.

    Args:
        text: writes expressions.
        value: what the statement evaluates.
        target: the variable to which it is assigned, if any.
    """
    match value:
        case syntax.Call(
            function=syntax.Name(name="use_moving_frame" | "USE_master_frame"), arguments=arguments
        ):
            return _moving(text, arguments, target)
        case syntax.Call(function=syntax.Name(name="linear_modeling"), arguments=sets):
            return small_lines(text, sets)
    return None


def _moving(text: Writer, arguments: tuple[syntax.Expression, ...], target: str) -> list[str]:
    """Return the master frame; frames hang on it when a command takes them."""
    written = items(text, arguments[:6])
    text.names.master = ""
    pose = text.text(arguments[6]) if len(arguments) > 6 else ""
    name = text.names.own("master")
    text.names.root().master = text.names.master = name
    line = f'{name} = sb.moving_frame({written}, name="moving_frame")'
    text.names.made[name] = line
    lines = [line, *_moved_gravity(text, name)]
    if not pose or not target:
        return lines
    return [*lines, *_tracking(text.names.own("pose"), text.names.own("own"), pose, target, written)]


def _moved_gravity(text: Writer, master: str) -> list[str]:
    """Return the line that hangs the gravity assigned before on the moving frame."""
    found = text.names.values.get("gravity")
    if not isinstance(found, Vector):
        return []
    known = text.names.values.get(master)
    if (
        isinstance(known, Frame) and found.frame.ancestor.key == known.ancestor.key
    ):  # of an earlier moving frame
        return []
    frame = master if found.frame.key == ground.key else f"{master}*gravity.frame"
    return [f"gravity = sb.Vector({frame}, *gravity.components)"]


def _tracking(name: str, own: str, pose: str, target: str, velocities: str) -> list[str]:
    """Return the tracking equations: the velocities of the pose along its own axes are the given ones.

    Args:
        name: the name of the pose.
        own: that of its velocities.
        pose: the text of the pose.
        target: the name of the equations.
        velocities: the text of the given velocities.
    """
    speeds = f"*sb.project(sb.velocity(sb.origin({name})), {name}).components"
    return [
        f"{name} = {pose}",
        f"{own} = [{speeds}, *sb.angular_velocity({name}).components]",
        f"{target} = [rate - given for rate, given in zip({own}, [{velocities}]) if not rate.is_constant]",
    ]
