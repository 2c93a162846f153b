"""The types of the arguments of MBSymba's commands: what each takes, and how another one is refused."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

from symbody.errors import WorksheetError
from symbody.symbolic import Expr
from symbody.worksheet.evaluation.session import Session
from symbody.worksheet.mechanics.objects import described, kind_of
from symbody.worksheet.values.value import (
    NULL,
    Array,
    Boolean,
    Listed,
    MapleSet,
    Reference,
    Relation,
    Sequence,
    String,
    Value,
)

__all__ = ["PARAMETERS", "Parameter", "check_arguments"]


@dataclass(frozen=True)
class Parameter:
    """A parameter of a command.

    Attributes:
        name: what the documentation calls it.
        types: the types that it may have, as keys of `_TYPES`.
    """

    name: str
    types: tuple[str, ...]


def _parameters(text: str) -> tuple[Parameter, ...]:
    """Return the parameters of a declaration such as ``P: POINT | VECTOR, T: frame``."""
    pairs = (each.split(":") for each in text.split(",") if each)
    return tuple(Parameter(name.strip(), tuple(types.replace(" ", "").split("|"))) for name, types in pairs)


_COMPONENT = "obj: POINT | VECTOR, T: frame"
_ABOUT = "system: system, A: point | matrix | NULL | boolean, T: matrix | boolean, verbose: boolean"
_TIRE = ("y", "z", "spin_def", "y_def", "z_def", "FX", "FY", "FZ", "MX", "MY", "MZ")
_SPEEDS = ("u", "v", "w", "ox", "oy", "oz")

PARAMETERS: Mapping[str, tuple[Parameter, ...]] = {
    command: _parameters(declaration)
    for command, declaration in {
        "inv_frame": "T: frame",
        "set_frame_name": "T: frame, name: name",
        "make_POINT": "T: frame",
        "make_VECTOR": "T: frame | POINT",
        "join_points": "P: POINT, Q: POINT",
        "origin": "T: frame",
        "CoM": "body: BODY",
        "uvec_X": "T: frame",
        "uvec_Y": "T: frame",
        "uvec_Z": "T: frame",
        "project": "obj: POINT | VECTOR | frame, T: frame",
        "dot_prod": "u: VECTOR, v: VECTOR",
        "cross_prod": "u: VECTOR, v: VECTOR",
        **dict.fromkeys(("comp_X", "comp_Y", "comp_Z", "comp_XYZ"), _COMPONENT),
        **dict.fromkeys(("Xcomp", "Ycomp", "Zcomp", "Comps"), _COMPONENT),
        "comp": f"component: name, {_COMPONENT}",
        "velocity": "P: POINT | VECTOR, T: frame | 'absolute'",
        "acceleration": "P: POINT | VECTOR, T: frame | 'absolute'",
        "angular_velocity": "T: frame, S: frame | 'absolute'",
        "frame_frozen_velocity": "P: POINT, T: frame",
        "make_BODY": "T: frame | POINT, m: scalar",
        "make_FORCE": "v: VECTOR | frame",
        "make_TORQUE": "v: VECTOR | frame",
        "kinetic_energy": "body: system",
        "gravitational_energy": "body: system",
        "linear_momentum": "body: system",
        "angular_momentum": "body: system, P: POINT",
        "power": "F: system",
        "newton_equations": "system: system, T: matrix | boolean, verbose: boolean",
        "euler_equations": _ABOUT,
        "generalized_force": "F: system, q: coordinates",
        "lagrange": "L: scalar, q: coordinates, t: name",
        "lagrange_equations": "system: system, q: coordinates, t: name | boolean, verbose: boolean",
        "first_order": "eqns: equations, q: coordinates, t: name",
        "linear_modeling": "variables: small",
        "spherical_JOINT": "P1: POINT, P2: POINT, b1: BODY | frame, b2: BODY | frame, tag: name",
        "make_CONSTRAINT": "phi: equations",
        "make_TIRE": ", ".join(["wheel: BODY", *(f"{name}: scalar" for name in _TIRE), "TR: frame"]),
        "tire_forces": "tire: TIRE",
        "tire_kinematics": "tire: TIRE",
        "use_moving_frame": ", ".join([*(f"{name}: scalar" for name in _SPEEDS), "T: frame"]),
    }.items()
}
"""The parameters of commands, as far as they have one type each; what follows them, the commands check themselves."""


def check_arguments(session: Session, command: str, arguments: tuple[Value, ...]) -> None:
    """Refuse an argument of a type that a command does not take.

    Raises:
        WorksheetError: which argument it is, what it is, and what is expected.
    """
    for parameter, argument in zip(PARAMETERS.get(command, ()), arguments, strict=False):
        found = session.resolve(argument)
        if parameter.types == ("name",):  # a name that has a value is one, too
            found = argument
        if not any(_TYPES[each].holds(session, found) for each in parameter.types):
            raise WorksheetError(
                f"{command}: {parameter.name} is {_told(session, found)}; expected {_listed(parameter.types)}"
            )


def _listed(types: tuple[str, ...]) -> str:
    """Return the names of types in words."""
    names = [_TYPES[each].text for each in types if _TYPES[each].text]
    return names[0] if len(names) == 1 else f"{', '.join(names[:-1])} or {names[-1]}"


def _told(session: Session, found: Value) -> str:
    if isinstance(found, Expr) and found.kind == "symbol":
        return f"the name {session.text(found)}, which has no value"
    if isinstance(found, Expr):
        return session.text(found)[:60]
    return described(found)


@dataclass(frozen=True)
class _Type:
    """A type of arguments: how messages call it, and what has it."""

    text: str
    holds: Callable[[Session, Value], bool]


def _of_kinds(*kinds: str) -> Callable[[Session, Value], bool]:
    return lambda session, value: kind_of(value) in kinds


def _is_matrix(value: Value) -> bool:
    return isinstance(value, Array) and (value.rows, value.columns) == (4, 4)


def _is_frame(session: Session, value: Value) -> bool:
    """Whether a value is a frame, or an object that has one."""
    return _is_matrix(value) or bool(kind_of(value))


def _is_scalar(session: Session, value: Value) -> bool:
    return isinstance(session.current(value), Expr)


def _is_system(session: Session, value: Value) -> bool:
    """Whether a value is an object, or a set of objects; what these are, the command tells."""
    return bool(kind_of(value)) or isinstance(value, MapleSet | Listed | Sequence)


def _is_coordinates(session: Session, value: Value) -> bool:
    items = value.items if isinstance(value, MapleSet | Listed | Sequence) else (value,)
    return all(isinstance(each, Expr | Listed) for each in items)


def _is_equations(session: Session, value: Value) -> bool:
    if isinstance(value, Array):
        return True
    items = value.items if isinstance(value, MapleSet | Listed | Sequence) else (value,)
    return all(
        isinstance(session.resolve(each), Expr | Relation | Listed | MapleSet | Array) for each in items
    )


def _is_small(session: Session, value: Value) -> bool:
    items = value.items if isinstance(value, MapleSet | Listed | Sequence) else (value,)
    return not any(isinstance(each, Expr) and each.is_number for each in items)


def _is_name(session: Session, value: Value) -> bool:
    return isinstance(value, String | Reference) or (isinstance(value, Expr) and value.kind == "symbol")


_TYPES: Mapping[str, _Type] = {
    "POINT": _Type(
        "a POINT", lambda session, value: kind_of(value) in ("POINT", "BODY") or _is_matrix(value)
    ),
    "VECTOR": _Type("a VECTOR", _of_kinds("VECTOR", "FORCE", "TORQUE")),
    "BODY": _Type("a BODY", _of_kinds("BODY")),
    "TIRE": _Type("a TIRE", _of_kinds("TIRE")),
    "point": _Type("a POINT", _of_kinds("POINT")),
    "frame": _Type("a frame", _is_frame),
    "matrix": _Type("a frame", lambda session, value: _is_matrix(value)),
    "scalar": _Type("an expression", _is_scalar),
    "system": _Type("an object, or a set of objects such as {body1, F1}", _is_system),
    "coordinates": _Type("a coordinate such as x(t), or a list of coordinates", _is_coordinates),
    "equations": _Type("an equation, or a list of equations", _is_equations),
    "small": _Type("a set of small variables, such as {x(t), psi(t)}", _is_small),
    "name": _Type("a name", _is_name),
    "boolean": _Type("true or false", lambda session, value: isinstance(value, Boolean)),
    "NULL": _Type("", lambda session, value: value == NULL),
    "'absolute'": _Type("'absolute'", lambda session, value: str(getattr(value, "name", "")) == "absolute"),
}
"""What the types of parameters hold: a body or a frame stands for its origin as a ``POINT``, and an object for its
frame as a ``frame``; a ``point`` and a ``matrix`` are just these."""
