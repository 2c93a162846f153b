"""MBSymba's commands, and the calls of symbody that say the same."""

from __future__ import annotations

import ast
import re
from collections.abc import Callable, Mapping
from typing import TypeAlias

from symbody.geometry import Frame, Point, Vector
from symbody.multibody import Body, Force, Torque
from symbody.symbolic import Expr, Matrix
from symbody.worksheet.convert.frames import axis, components, frame
from symbody.worksheet.convert.names import NoText
from symbody.worksheet.convert.operations import SUM, grouped, product
from symbody.worksheet.convert.selections import word_of
from symbody.worksheet.convert.sequences import item, items
from symbody.worksheet.convert.tyres import tyre_forces, tyre_motion
from symbody.worksheet.convert.writer import Arguments, Writer
from symbody.worksheet.sheet import syntax

__all__ = ["MECHANICS"]

Call: TypeAlias = Callable[[Writer, Arguments], str]


def _framed(function: str, *places: int) -> Call:
    """Return the writer of a function with the same arguments, of which those at some places are frames."""

    def write(text: Writer, arguments: Arguments) -> str:
        parts = [frame(text, each) if k in places else item(text, each) for k, each in enumerate(arguments)]
        return f"{function}({', '.join(parts)})"

    return write


def _of_vectors(function: str) -> Call:
    """Return the writer of a function of vectors; a force or a torque stands for its vector."""

    def write(text: Writer, arguments: Arguments) -> str:
        parts = [item(text, each) for each in arguments]
        vectors = [
            f"{grouped(each)}.vector" if isinstance(text.value(each), Force | Torque) else each
            for each in parts
        ]
        return f"{function}({', '.join(vectors)})"

    return write


def _moved(function: str, count: int) -> Call:
    """Return the writer of ``translate`` and ``rotate``, which also move an object."""

    def write(text: Writer, arguments: Arguments) -> str:
        first = axis(text, arguments[0]) if count == 2 else item(text, arguments[0])
        motion = f"{function}({', '.join([first, *(item(text, each) for each in arguments[1:count])])})"
        if len(arguments) <= count:
            return motion
        if len(arguments) > count + 1:
            raise NoText(function)
        whole = text.text(arguments[count])
        if isinstance(text.value(whole), Frame):
            return product(whole, motion)
        moved = f"sb.displaced({whole}, {motion})"
        found = text.value(whole)
        if isinstance(found, Body):
            return moved
        return f"sb.project({moved}, {grouped(whole)}.frame)"

    return write


def _point(text: Writer, arguments: Arguments) -> str:
    if len(arguments) == 3:
        return f"sb.Point({text.names.master or 'sb.ground'}, {items(text, arguments)})"
    return f"sb.Point({frame(text, arguments[0])}, {items(text, arguments[1:])})"


def _vector(text: Writer, arguments: Arguments) -> str:
    if len(arguments) == 4:
        return f"sb.Vector({frame(text, arguments[0])}, {items(text, arguments[1:])})"
    if len(arguments) == 3:
        return f"sb.Vector({text.names.master or 'sb.ground'}, {items(text, arguments)})"
    first, second = (text.text(each) for each in arguments)
    return f"sb.project({grouped(second, SUM)} - {grouped(first)}, {grouped(first)}.frame)"


def _force(text: Writer, arguments: Arguments) -> str:
    return _load(text, "Force", arguments, ("at", "on", "reaction"), most=3)


def _torque(text: Writer, arguments: Arguments) -> str:
    return _load(text, "Torque", arguments, ("on", "reaction"), most=2)


def _load(text: Writer, kind: str, arguments: Arguments, names: tuple[str, ...], *, most: int) -> str:
    """Return a load; one on the ground with its reaction on a body is the opposite load on the body.

    Args:
        text: writes expressions.
        kind: the name of the class.
        arguments: those of the command.
        names: the keywords of the arguments behind the vector.
        most: how many arguments a load by a vector has at most.
    """
    what, rest = _loaded(text, arguments, 4, most)
    named = {name: value for name, value in zip(names, rest, strict=False) if value != "0"}
    if "reaction" in named and isinstance(text.value(named.get("on", "")), Frame):
        count = len(arguments) - len(rest)
        opposite = map(_opposite, arguments[count > 1 : count])
        what, _ = _loaded(text, (*arguments[: count > 1], *opposite, *arguments[count:]), 4, most)
        named["on"] = named.pop("reaction")
    return f"sb.{kind}({what}, {', '.join(f'{name}={value}' for name, value in named.items())})"


def _opposite(node: syntax.Expression) -> syntax.Expression:
    is_zero = isinstance(node, syntax.Integer) and not node.value
    return node if is_zero else syntax.Prefix("-", node, place=node.place)


def _loaded(text: Writer, arguments: Arguments, count: int, most: int) -> tuple[str, list[str]]:
    """Return what a load does, by components or by a vector, and the other arguments."""
    first = text.text(arguments[0])
    by_components = len(arguments) > most and isinstance(text.value(first), Frame | Matrix)
    taken = count if by_components else 1
    what = f"{frame(text, arguments[0])}, {items(text, arguments[1:taken])}" if by_components else first
    return what, [text.text(each) for each in arguments[taken:]]


def _body(text: Writer, arguments: Arguments) -> str:
    place = frame(text, arguments[0])
    if len(arguments) == 3:
        inertia = text.text(arguments[2])
        if isinstance(text.value(inertia), Matrix):
            return f"sb.Body.of_inertia({place}, {text.text(arguments[1])}, {inertia})"
    return f"sb.Body({place}, {items(text, arguments[1:])})"


def _heavy(function: str, *places: int) -> Call:
    """Return the writer of a function to which gravity is given, once the sheet has assigned it."""

    def write(text: Writer, arguments: Arguments) -> str:
        has_gravity = isinstance(text.names.values.get("gravity"), Vector)
        if not has_gravity and function == "sb.gravitational_energy":
            return "0"
        gravity = ", gravity=gravity" if has_gravity else ""
        return f"{_framed(function, *places)(text, arguments)[:-1]}{gravity})"

    return write


def _component(index: int) -> Call:
    return lambda text, arguments: f"{components(text, arguments)}[{index}]"


def _chosen(text: Writer, arguments: Arguments) -> str:
    """Return the components that letters name: ``comp('XY', v, T)``."""
    letters = word_of(arguments[0])
    if not letters or not set(letters) <= set("XYZ"):
        raise NoText("comp")
    found = [f"{components(text, arguments[1:])}[{'XYZ'.index(letter)}]" for letter in letters]
    return found[0] if len(found) == 1 else f"({', '.join(found)})"


def _unit(index: int) -> Call:
    components = ", ".join(str(int(k == index)) for k in range(3))
    return lambda text, arguments: f"sb.Vector({frame(text, arguments[0])}, {components})"


def _center(text: Writer, arguments: Arguments) -> str:
    whole = text.text(arguments[0])
    if isinstance(text.value(whole), list):
        return f"sb.center_of_mass({whole})"
    return f"{grouped(whole)}.center_of_mass"


def _origin(text: Writer, arguments: Arguments) -> str:
    """Return the origin of a frame, or of that of a body, a point or a vector."""
    whole = text.text(arguments[0])
    if isinstance(text.value(whole), Body | Point | Vector):
        return f"sb.origin({grouped(whole)}.frame)"
    return f"sb.origin({frame(text, arguments[0])})"


def _velocity(function: str) -> Call:
    """Return the writer of a velocity: of a point, which may be the origin of a frame."""

    def write(text: Writer, arguments: Arguments) -> str:
        first = text.text(arguments[0])
        if isinstance(text.value(first), Frame):
            first = f"sb.origin({frame(text, arguments[0])})"
        elif isinstance(text.value(first), Body):
            first = f"{grouped(first)}.center_of_mass"
        rest = [frame(text, each) for each in arguments[1:]]
        return f"{function}({', '.join([first, *rest])})"

    return write


def _spin(text: Writer, arguments: Arguments) -> str:
    """Return the angular velocity of a frame, also relative to another one, in the axes of the first."""
    of, *others = (frame(text, each) for each in arguments)
    relative = "".join(f" - sb.project(sb.angular_velocity({other}), {of})" for other in others)
    return f"sb.angular_velocity({of}){relative}"


def _lagrange(text: Writer, arguments: Arguments) -> str:
    """Return Lagrange's expression for a coordinate, or those for a list of coordinates."""
    energy, unknown = (text.text(each) for each in arguments[:2])
    if isinstance(text.value(unknown), list):
        return _lagrange_of(energy, unknown)
    return f"sb.lagrange({energy}, {unknown})"


def _lagrange_of_system(text: Writer, arguments: Arguments) -> str:
    """Return d/dt dT/dq' - dT/dq - Q of bodies and loads, with their weight."""
    objects, unknown = text.text(arguments[0]), text.text(arguments[1])
    found = text.value(objects)
    if not isinstance(found, list):
        raise NoText("lagrange_equations")
    coordinates = unknown if isinstance(text.value(unknown), list) else f"[{unknown}]"
    bodies = [each for each in found if isinstance(each, Body)]
    gravity = "gravity" if isinstance(text.names.values.get("gravity"), Vector) else ""
    if len(bodies) == len(found):
        weight = f" - sb.gravitational_energy({objects}, {gravity})" if gravity else ""
        return _lagrange_of(f"sb.kinetic_energy({objects}){weight}", coordinates)
    heavy = f", gravity={gravity}" if gravity else ""
    heavy_bodies, loads = _divided(text, objects)
    system = f"sb.System({heavy_bodies}, {loads}, coordinates={coordinates}{heavy})"
    return f"list(sb.lagrange_equations({system}).residuals)"


def _lagrange_of(energy: str, coordinates: str) -> str:
    """Return Lagrange's expressions for a list of coordinates."""
    single = re.fullmatch(r"\[(\w+)\]", coordinates)
    if single:
        return f"[sb.lagrange({energy}, {single[1]})]"
    return f"[sb.lagrange({energy}, each) for each in {coordinates}]"


def _divided(text: Writer, objects: str) -> tuple[str, str]:
    """Return the bodies and the loads of a list: name by name, if it is written out."""
    node = ast.parse(objects, mode="eval").body
    if not isinstance(node, ast.List) or any(isinstance(each, ast.Starred) for each in node.elts):
        return (
            f"[each for each in {objects} if isinstance(each, sb.Body)]",
            f"[each for each in {objects} if not isinstance(each, sb.Body)]",
        )
    names = [ast.unparse(each) for each in node.elts]
    bodies = [name for name in names if isinstance(text.value(name), Body)]
    loads = [name for name in names if name not in bodies]
    return f"[{', '.join(bodies)}]", f"[{', '.join(loads)}]"


def _linearized(text: Writer, arguments: Arguments) -> str:
    whole = text.text(arguments[0])
    if len(arguments) == 1:
        return f"sb.taylor({whole})"
    about = text.text(arguments[1])
    found = text.value(about)
    if isinstance(found, list) and all(isinstance(each, Expr) for each in found):
        return f"sb.taylor({whole}, dict.fromkeys({about}, 0))"
    return f"sb.taylor({whole}, {about})"


def _summed(sign: str) -> Call:
    return lambda text, arguments: (
        f"{grouped(text.text(arguments[0]), SUM)} {sign} {grouped(text.text(arguments[1]), SUM + 1)}"
    )


def _inverse(text: Writer, arguments: Arguments) -> str:
    whole = text.text(arguments[0])
    return (
        f"sb.Frame({whole}).inverse()"
        if isinstance(text.value(whole), Matrix)
        else f"{grouped(whole)}.inverse()"
    )


def _copied(text: Writer, arguments: Arguments) -> str:
    whole = text.text(arguments[0])
    found = text.value(whole)
    return (
        f"dict({whole})"
        if isinstance(found, dict)
        else f"list({whole})"
        if isinstance(found, list)
        else whole
    )


MECHANICS: Mapping[str, Call] = {
    **dict.fromkeys(("translate", "Translate"), _moved("sb.translate", 3)),
    **dict.fromkeys(("rotate", "Rotate"), _moved("sb.rotate", 2)),
    "inv_frame": _inverse,
    "make_POINT": _point,
    **dict.fromkeys(("make_VECTOR", "join_points"), _vector),
    "make_BODY": _body,
    "make_FORCE": _force,
    "make_TORQUE": _torque,
    "origin": _origin,
    "CoM": _center,
    "frame_frozen_velocity": _framed("sb.frozen_velocity", 1),
    "project": _framed("sb.project", 1),
    "dot_prod": _of_vectors("sb.dot"),
    "cross_prod": _of_vectors("sb.cross"),
    **dict.fromkeys(("comp_X", "Xcomp"), _component(0)),
    **dict.fromkeys(("comp_Y", "Ycomp"), _component(1)),
    **dict.fromkeys(("comp_Z", "Zcomp"), _component(2)),
    **dict.fromkeys(("comp_XYZ", "Comps"), components),
    **{f"uvec_{axis}": _unit(index) for index, axis in enumerate("XYZ")},
    **{name: _velocity(f"sb.{name}") for name in ("velocity", "acceleration")},
    "angular_velocity": _spin,
    "comp": _chosen,
    "linear_momentum": _framed("sb.linear_momentum", 1),
    "angular_momentum": _framed("sb.angular_momentum", 2),
    "kinetic_energy": _framed("sb.kinetic_energy"),
    "power": _framed("sb.power"),
    "generalized_force": _framed("sb.generalized_force"),
    "gravitational_energy": _heavy("sb.gravitational_energy"),
    "newton_equations": _heavy("sb.newton_equations", 1),
    "euler_equations": _heavy("sb.euler_equations", 2),
    "lagrange": _lagrange,
    "lagrange_equations": _lagrange_of_system,
    "linearize": _linearized,
    "add_vectors": _summed("+"),
    "copy": _copied,
    "tire_forces": tyre_forces,
    "tire_kinematics": tyre_motion,
}
"""Writers by the names of commands."""
