"""The tyre of MBSymba's add-on by the functions of symbody: contact, slip velocities, force and torque."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass

from symbody.geometry import Frame
from symbody.multibody import Body
from symbody.symbolic import Expr, diff, t
from symbody.worksheet.commands.tyres import tyre_axes
from symbody.worksheet.convert.frames import frame
from symbody.worksheet.convert.names import NoText
from symbody.worksheet.convert.operations import POWER, SUM, grouped
from symbody.worksheet.convert.writer import Arguments, Writer

__all__ = ["Tyre", "tyre_forces", "tyre_lines", "tyre_load_lines", "tyre_motion"]


@dataclass(frozen=True, slots=True)
class Tyre:
    """A tyre of the program by texts: its variable, wheel, axes, contact point, road, and loads along its axes."""

    variable: str
    wheel: str
    axes: str
    contact: str
    road: str
    loads: tuple[str, ...]


def tyre_lines(text: Writer, variable: str, arguments: Arguments) -> list[str]:
    """Return the line that makes a tyre: how its wheel moves at the contact."""
    wheel, *scalars = arguments[:12]
    written = [text.text(each) for each in scalars] + ["0"] * (11 - len(scalars))
    y, z, spin, y_def, z_def, *loads = written
    body = text.text(wheel)
    road = frame(text, arguments[12]) if len(arguments) > 12 else text.names.master or "sb.ground"
    carrier = _carrier(text, body, road)
    axes = carrier or text.names.own(f"{_bare(variable)}_axes")
    begin = []
    if not carrier:
        begin = [f"{axes} = tire_frame({grouped(body)}.frame, {road})"]
        exec(begin[0], text.names.values)
    contact = f"sb.Point({axes}, 0, {_sum(y, y_def)}, {_sum(z, z_def)})"
    more = {"spin_deformation": _minus(spin), "y_deformation": _minus(y_def), "z_deformation": z_def}
    shape = ", ".join([_minus(y), z, *(f"{name}={value}" for name, value in more.items() if value != "0")])
    depth = f"sb.project({contact}, {road}).coordinates[2]"
    deep = text.names.own("road_depth") if _is_moved(text, depth, road) else ""
    if deep:
        begin.append(f'{deep} = sb.symbols("{deep}")')
        exec(begin[-1], text.names.values)
    surface = f'{road}*sb.translate(0, 0, {deep or depth})*sb.rotate("X", sb.pi)'
    text.names.tyres[variable] = Tyre(variable, body, axes, contact, road, tuple(loads))
    return [
        *begin,
        f"{variable} = sb.tire_kinematics(",
        f"    {body},",
        f"    sb.tire_shape({shape}),",
        f"    road={surface},",
        *([f"    carrier={carrier},"] if carrier else []),
        '    spin_axis="-Y",',
        ")",
        *([f"{variable} = {variable}._make(sb.subs([*{variable}], {{{deep}: {depth}}}))"] if deep else []),
    ]


def _is_moved(text: Writer, depth: str, road: str) -> bool:
    """Whether a depth that changes is on a moving frame: the road is at rest all the same."""
    deep, on = text.value(depth), text.value(road)
    is_moving = isinstance(on, Frame) and on.ancestor.carrier is not None
    return is_moving and isinstance(deep, Expr) and not diff(deep, t).is_zero


def _carrier(text: Writer, body: str, road: str) -> str:
    """Return the frame of the wheel without its spin, if x is along the road there; nothing otherwise."""
    wheel, on = text.value(body), text.value(road)
    if not isinstance(wheel, Body) or not isinstance(on, Frame):
        raise NoText("make_TIRE")
    frame, is_carrier = tyre_axes(wheel.frame, on)
    if not is_carrier:
        return ""
    path = f"{grouped(body)}.frame"
    while isinstance(text.value(path), Frame) and text.value(path).matrix != frame.matrix:
        path = f"{path}.parent"
    return path


def _bare(variable: str) -> str:
    """Return a name for what belongs to a variable, which may be the entry of a table."""
    return re.sub(r"\W+", "_", variable).strip("_")


def _sum(a: str, b: str) -> str:
    return a if b == "0" else b if a == "0" else f"{a} + {grouped(b, SUM + 1)}"


def _minus(text: str) -> str:
    """Return the negative of a text; that of ``-N`` is N, unless this is the first term of a sum."""
    if text == "0":
        return text
    is_negative = text.startswith("-") and grouped(text, SUM + 1) == text
    return text[1:] if is_negative else f"-{grouped(text, POWER)}"


def _found(text: Writer, arguments: Arguments) -> Tyre:
    found: Tyre | None = text.names.tyres.get(text.text(arguments[0]))
    if found is None:
        raise NoText("tyre")
    return found


def tyre_motion(text: Writer, arguments: Arguments) -> str:
    """Return the contact, and the speeds VS, VN and VR with the signs of the add-on."""
    tyre = _found(text, arguments)
    name, short = tyre.variable, "sb.taylor" if text.names.small else "sb.simplify"
    return f"({tyre.contact}, {short}({name}.VS), {short}(-{name}.VN), {short}({name}.VR))"


def tyre_forces(text: Writer, arguments: Arguments) -> str:
    """Return the force at the centre of the wheel, and the torque with the moment of the contact force."""
    return f"({', '.join(_loads(text, _found(text, arguments), ''))})"


def tyre_load_lines(text: Writer, targets: Sequence[str], arguments: Arguments) -> list[str]:
    """Return the lines that make the force and the torque of a tyre, which needs the force."""
    loads = _loads(text, _found(text, arguments), f"{targets[0]}.vector")
    return [f"{target} = {load}" for target, load in zip(targets, loads, strict=True)]


def _loads(text: Writer, tyre: Tyre, pushed_before: str) -> tuple[str, str]:
    """Return the force and the torque of a tyre.

    Args:
        text: writes the statement; in linear models, loads keep the first order.
        tyre: the tyre.
        pushed_before: the vector of the force where it has a name.
    """
    force, moment = (_along(tyre.variable, loads) for loads in (tyre.loads[:3], tyre.loads[3:]))
    center = f"{grouped(tyre.wheel)}.center_of_mass"
    lever = f"sb.project({tyre.contact} - {center}, {tyre.axes})"
    pushed = f"sb.project({force}, {tyre.axes})" if force else "0"
    if force and text.names.small:
        pushed = f"sb.taylor({pushed})"
    torque = f"sb.cross({lever}, {pushed_before or pushed})"
    if moment:
        torque = f"sb.project({moment}, {tyre.axes}) + {torque}"
    if text.names.small:
        torque = f"sb.taylor({torque})"
    return (
        f"sb.Force({pushed}, at={center}, on={tyre.wheel})",
        f"sb.Torque({torque}, on={tyre.wheel})",
    )


def _along(name: str, loads: tuple[str, ...]) -> str:
    """Return the sum of loads along the axes of the contact: ahead, to the right, downwards."""
    ahead, right, down = (*loads, "0", "0", "0")[:3]
    along = {"longitudinal": ahead, "lateral": _minus(right), "normal": _minus(down)}
    terms = [
        f"-{name}.{axis}*{grouped(load[1:], POWER)}"
        if load.startswith("-") and grouped(load, SUM + 1) == load
        else f"{name}.{axis}*{grouped(load, POWER)}"
        for axis, load in along.items()
        if load != "0"
    ]
    return " + ".join(terms).replace("+ -", "- ")
