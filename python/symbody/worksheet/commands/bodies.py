"""Commands that make bodies, forces and torques, and those of energy, momentum and power."""

from __future__ import annotations

from typing import TYPE_CHECKING

from symbody.deferred import Deferred
from symbody.errors import WorksheetError
from symbody.geometry import Vector, velocity
from symbody.geometry.motion.translation import Translation
from symbody.symbolic import ENERGY, Expr, derivation, dot3, number
from symbody.worksheet.evaluation.session import Command, Session
from symbody.worksheet.mechanics import frame_face
from symbody.worksheet.mechanics.modes import mechanics
from symbody.worksheet.mechanics.objects import (
    Reader,
    described,
    face_of,
    get,
    kind_of,
    made,
    members,
    table_of_vector,
    vector_entries,
    written,
)
from symbody.worksheet.mechanics.small_variables import result
from symbody.worksheet.values.value import Array, Listed, Table, Value

if TYPE_CHECKING:
    from symbody import multibody
    from symbody.multibody import Body, Load
else:
    multibody = Deferred("symbody.multibody")

__all__ = ["COMMANDS", "gravity"]


def make_BODY(session: Session, place: Value, mass: Value | None = None, *inertia: Value) -> Value:
    """make_BODY(T, m, Ix, Iy, Iz, Cyz, Cxz, Cxy): a body; its centre of mass is a point, or the origin of a frame."""
    reader = Reader(session, "make_BODY")
    modes = mechanics(session)
    return made(
        "BODY",
        frame=_carrier(reader, place),
        mass=number(0) if mass is None else session.current(mass),
        inertia=Array(3, 3, _tensor(session, inertia), modes.matrix_kind),
    )


def _carrier(reader: Reader, place: Value) -> Value:
    """Return the frame at the centre of mass: that of a point, displaced to it."""
    session = reader.session
    table = session.resolve(place)
    if not isinstance(table, Table):
        reader.chain(place)
        return reader.frame_value(place)
    table = reader.object(place, "POINT", "BODY")
    shown = get(table, "frame") or frame_face.ground_face(mechanics(session))
    if kind_of(table) == "BODY":
        return shown
    coordinates = vector_entries(session, table, "coords", reader.where)
    if all(each.is_zero for each in coordinates):
        return shown
    return face_of(session, reader.chain(table).then(Translation(coordinates)))


_TENSOR = (0, -6, -5, -6, 1, -4, -5, -4, 2)
"""Where the entries of the tensor are among Ix, Iy, Iz, Cyz, Cxz, Cxy: -1 - k says minus the k-th one."""


def _tensor(session: Session, given: tuple[Value, ...]) -> list[Value]:
    """Return the nine entries of the tensor: products of inertia have a minus sign."""
    if len(given) == 1 and isinstance(matrix := session.resolve(given[0]), Array):
        if (matrix.rows, matrix.columns) != (3, 3):
            raise WorksheetError(
                f"make_BODY: an inertia matrix of {matrix.rows}x{matrix.columns}; expected 3x3, or Ix, Iy, Iz"
            )
        return list(matrix.entries)
    values = [session.current(each) for each in given]
    if len(values) > 6 or not all(isinstance(value, Expr) for value in values):
        raise WorksheetError("make_BODY: expected a mass and up to six inertias: Ix, Iy, Iz, Cyz, Cxz, Cxy")
    entries = [value for value in values if isinstance(value, Expr)]
    entries += [number(0)] * (6 - len(entries))
    return [entries[k] if k >= 0 else -entries[-1 - k] for k in _TENSOR]


# --- forces and torques ---


def make_FORCE(session: Session, what: Value, *others: Value) -> Value:
    """make_FORCE(v, P, b1 [, b2]) or make_FORCE(T, x, y, z, P, b1 [, b2]): a force at P on b1, -v on b2."""
    reader = Reader(session, "make_FORCE")
    vector, rest = _vector(reader, what, others)
    if not 2 <= len(rest) <= 3:
        raise WorksheetError(
            "make_FORCE: expected make_FORCE(vector, point, body) or make_FORCE(T, x, y, z, point, body); a second "
            "body takes the reaction"
        )
    reader.point(rest[0])
    return made(
        "FORCE",
        frame=get(vector, "frame"),
        acting=_body(reader, rest[1]),
        comps=get(vector, "comps"),
        applied=rest[0],
        reacting=_reacting(reader, rest[2:]),
    )


def make_TORQUE(session: Session, what: Value, *others: Value) -> Value:
    """make_TORQUE(v, b1 [, b2]) or make_TORQUE(T, x, y, z, b1 [, b2]): a torque on b1, with its reaction on b2."""
    reader = Reader(session, "make_TORQUE")
    vector, rest = _vector(reader, what, others)
    if not 1 <= len(rest) <= 2:
        raise WorksheetError(
            "make_TORQUE: expected make_TORQUE(vector, body) or make_TORQUE(T, x, y, z, body); a second body takes the "
            "reaction"
        )
    return made(
        "TORQUE",
        frame=get(vector, "frame"),
        acting=_body(reader, rest[0]),
        comps=get(vector, "comps"),
        reacting=_reacting(reader, rest[1:]),
    )


def _vector(reader: Reader, what: Value, others: tuple[Value, ...]) -> tuple[Table, tuple[Value, ...]]:
    """Return the table of the vector, given as one or by its frame and components, and the other arguments."""
    table = reader.session.resolve(what)
    if isinstance(table, Table) and kind_of(table) in {"VECTOR", "FORCE", "TORQUE"}:
        return table, others
    reader.chain(what)
    first = reader.session.resolve(others[0]) if others else None
    count = 1 if isinstance(first, Listed | Array) and not frame_face.is_frame(first) else 3
    return written(reader.session, "VECTOR", reader.triple(others[:count]), reader.frame_value(what)), others[
        count:
    ]


def _body(reader: Reader, value: Value) -> Value:
    """Return a body, or the master frame, as the sheet gives it."""
    found = reader.session.resolve(value)
    if kind_of(found) == "BODY" or frame_face.is_frame(found):
        return value
    raise WorksheetError(f"{reader.where}: {described(found)}; expected a body on which it acts")


def _reacting(reader: Reader, rest: tuple[Value, ...]) -> Value | None:
    """Return the body that takes the reaction; the master frame needs no mention."""
    if not rest or frame_face.is_frame(reader.session.resolve(rest[0])):
        return None
    return _body(reader, rest[0])


# --- energy, momentum, power ---


def gravity(reader: Reader) -> Vector | None:
    """Return the acceleration of gravity, the global name _gravity; None without it."""
    table = reader.session.resolve(reader.session.names.get("_gravity", number(0)))
    if kind_of(table) != "VECTOR":
        return None
    vector = reader.vector(table)
    return None if all(each.is_zero for each in vector.components) else vector


def _bodies(reader: Reader, value: Value) -> list[Body]:
    items = members(reader.session, value)
    for item in items:
        reader.check_object(item)
    found = [item for item in items if kind_of(reader.session.resolve(item)) == "BODY"]
    if not found:
        raise WorksheetError(f"{reader.where}: no body; expected a body, or a set of bodies")
    return [reader.body(item) for item in found]


def kinetic_energy(session: Session, objects: Value) -> Value:
    """kinetic_energy(body): the kinetic energy of a body, or of a set of bodies."""
    reader = Reader(session, "kinetic_energy")
    energies = result(mechanics(session), _kinetic_energies(_bodies(reader, objects)), ENERGY)
    return min(energies, key=lambda energy: len(str(energy)))


def _kinetic_energies(bodies: list[Body]) -> tuple[Expr, Expr]:
    """Return the kinetic energy by velocities along the axes of each body, and along those of the ground."""
    spins = [
        multibody.Body.of_inertia(body.center_of_mass, 0, body.inertia)
        for body in bodies
        if not body.is_particle
    ]
    fixed = multibody.kinetic_energy(spins) if spins else number(0)
    for body in bodies:
        v = velocity(body.center_of_mass).components
        fixed += body.mass * dot3(v, v) / 2
    return multibody.kinetic_energy(bodies), fixed


def gravitational_energy(session: Session, objects: Value) -> Value:
    """gravitational_energy(body): -m g . r_G; 0 without _gravity; by the coordinates in a moving frame."""
    reader = Reader(session, "gravitational_energy", hung=False)
    bodies, g = _bodies(reader, objects), gravity(reader)
    energy = number(0) if g is None else multibody.gravitational_energy(bodies, g)
    return result(mechanics(session), [energy], ENERGY)[0]


def linear_momentum(session: Session, objects: Value) -> Value:
    """linear_momentum(body): the linear momentum of a body, or of a set, in the axes of the ground."""
    reader = Reader(session, "linear_momentum")
    return table_of_vector(session, multibody.linear_momentum(_bodies(reader, objects)))


def angular_momentum(session: Session, objects: Value, point: Value | None = None) -> Value:
    """angular_momentum(body, P): the angular momentum about a point, in the axes of the body."""
    reader = Reader(session, "angular_momentum")
    bodies = _bodies(reader, objects)
    about = None if point is None else reader.point(point)
    single = members(session, objects)[0] if len(bodies) == 1 else None
    frame = None if single is None else reader.frame_value(single)
    return table_of_vector(session, multibody.angular_momentum(bodies, about), frame)


def power(session: Session, loads: Value) -> Value:
    """power(F): the power of a force or a torque, or of a set of them."""
    reader = Reader(session, "power")
    found: list[Load] = [load for item in members(session, loads) if (load := reader.load(item)) is not None]
    with derivation(order=ENERGY):
        total = sum((multibody.power(load) for load in found), start=number(0))
    return result(mechanics(session), [total], ENERGY)[0]


COMMANDS: dict[str, Command] = {
    "make_BODY": make_BODY,
    "make_FORCE": make_FORCE,
    "make_TORQUE": make_TORQUE,
    "kinetic_energy": kinetic_energy,
    "gravitational_energy": gravitational_energy,
    "linear_momentum": linear_momentum,
    "angular_momentum": angular_momentum,
    "power": power,
}
