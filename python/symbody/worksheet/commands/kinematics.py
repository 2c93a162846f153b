"""Commands of points and vectors, their components and their velocities."""

from __future__ import annotations

from symbody.errors import WorksheetError
from symbody.geometry import Point, Vector, cross, dot, frozen_velocity
from symbody.geometry import acceleration as acceleration_of
from symbody.geometry import angular_velocity as spin_of
from symbody.geometry import velocity as velocity_of
from symbody.symbolic import ENERGY, Expr, derivation, number
from symbody.worksheet.evaluation.session import Command, Session
from symbody.worksheet.mechanics import frame_face
from symbody.worksheet.mechanics.modes import mechanics
from symbody.worksheet.mechanics.objects import (
    Reader,
    computed,
    fields_of,
    get,
    kind_of,
    table_of_vector,
    written,
)
from symbody.worksheet.mechanics.small_variables import result
from symbody.worksheet.values.value import Array, Reference, Sequence, String, Table, Value

__all__ = ["COMMANDS", "join_points"]

# --- points and vectors ---


def make_POINT(session: Session, frame: Value, *coordinates: Value) -> Value:
    """make_POINT(T, x, y, z): a point, by its coordinates in a frame."""
    reader = Reader(session, "make_POINT")
    reader.chain(frame)
    return written(session, "POINT", reader.triple(coordinates), reader.frame_value(frame))


def make_VECTOR(session: Session, frame: Value, *components: Value) -> Value:
    """make_VECTOR(T, u, v, w): a vector, by its components in a frame; make_VECTOR(P, Q): the vector from P to Q."""
    if len(components) == 1 and kind_of(session.resolve(components[0])) in {"POINT", "BODY"}:
        return join_points(session, frame, components[0])
    reader = Reader(session, "make_VECTOR")
    reader.chain(frame)
    return written(session, "VECTOR", reader.triple(components), reader.frame_value(frame))


def join_points(session: Session, P: Value, Q: Value) -> Value:
    """join_points(P, Q): the vector from P to Q, in the frame of P."""
    reader = Reader(session, "join_points")
    vector = reader.point(Q) - reader.point(P)
    table = computed(session, "VECTOR", vector.components, reader.frame_value(P))
    table.memory = vector
    return table


def origin(session: Session, frame: Value) -> Value:
    """origin(T): the origin of a frame."""
    reader = Reader(session, "origin")
    reader.chain(frame)
    null = number(0), number(0), number(0)
    return written(session, "POINT", null, reader.frame_value(frame))


def uvec_X(session: Session, frame: Value) -> Value:
    """uvec_X(T): the unit vector along the x axis of a frame; uvec_Y and uvec_Z likewise."""
    return make_VECTOR(session, frame, number(1), number(0), number(0))


def uvec_Y(session: Session, frame: Value) -> Value:
    """uvec_Y(T): the unit vector along the y axis of a frame."""
    return make_VECTOR(session, frame, number(0), number(1), number(0))


def uvec_Z(session: Session, frame: Value) -> Value:
    """uvec_Z(T): the unit vector along the z axis of a frame."""
    return make_VECTOR(session, frame, number(0), number(0), number(1))


def project(session: Session, thing: Value, frame: Value) -> Value:
    """project(obj, T): a point, vector, force or torque, by its components in another frame."""
    reader = Reader(session, "project")
    if isinstance(array := session.resolve(thing), Array):
        seen = reader.chain(frame).inverse() * reader.chain(array)
        return frame_face.face(mechanics(session), seen)
    table = reader.object(thing, "POINT", "VECTOR", "FORCE", "TORQUE")
    axes, shown = reader.frame(frame), _named(session, reader.frame_value(frame))
    if kind_of(table) == "POINT":
        return computed(session, "POINT", reader.point(table).projected(axes).coordinates, shown)
    vector = reader.vector(table).projected(axes)
    fields = fields_of(table, "acting", "reacting", "applied")
    projected = computed(session, kind_of(table), vector.components, shown, **fields)
    projected.memory = vector
    return projected


def _named(session: Session, frame: Value) -> Value:
    """Return a frame for a field: the ground as what it is shown as."""
    array = session.resolve(frame)
    if isinstance(frame, Reference) and frame.name in frame_face.GROUNDS and isinstance(array, Array):
        return frame_face.ground_face(mechanics(session))
    return frame


def dot_prod(session: Session, u: Value, v: Value) -> Value:
    """dot_prod(u, v): the scalar product."""
    reader = Reader(session, "dot_prod")
    return result(mechanics(session), [dot(reader.vector(u), reader.vector(v))])[0]


def cross_prod(session: Session, u: Value, v: Value) -> Value:
    """cross_prod(u, v): the vector product, in the frame of u; a torque on the same bodies, if u or v is a force."""
    reader = Reader(session, "cross_prod")
    product = cross(reader.vector(u), reader.vector(v)).components
    forces = [table for table in map(session.resolve, (u, v)) if kind_of(table) == "FORCE"]
    if len(forces) == 1 and isinstance(forces[0], Table):
        bodies = fields_of(forces[0], "acting", "reacting")
        return computed(session, "TORQUE", product, reader.frame_value(u), **bodies)
    return computed(session, "VECTOR", product, reader.frame_value(u))


# --- components ---


def _components(session: Session, where: str, thing: Value, frame: Value | None) -> tuple[Expr, ...]:
    reader = Reader(session, where)
    table = reader.object(thing, "POINT", "VECTOR", "FORCE", "TORQUE")
    seen: Point | Vector = reader.point(table) if kind_of(table) == "POINT" else reader.vector(table)
    if frame is not None:
        seen = seen.projected(reader.frame(frame))
    entries = seen.coordinates if isinstance(seen, Point) else seen.components
    return result(mechanics(session), entries)


def comp_X(session: Session, thing: Value, frame: Value | None = None) -> Value:
    """comp_X(obj [, T]): the x component of a vector, or the x coordinate of a point; in the axes of T."""
    return _components(session, "comp_X", thing, frame)[0]


def comp_Y(session: Session, thing: Value, frame: Value | None = None) -> Value:
    """comp_Y(obj [, T]): the y component of a vector, or the y coordinate of a point; in the axes of T."""
    return _components(session, "comp_Y", thing, frame)[1]


def comp_Z(session: Session, thing: Value, frame: Value | None = None) -> Value:
    """comp_Z(obj [, T]): the z component of a vector, or the z coordinate of a point; in the axes of T."""
    return _components(session, "comp_Z", thing, frame)[2]


def comp_XYZ(session: Session, thing: Value, frame: Value | None = None) -> Value:
    """comp_XYZ(obj [, T]): the sequence of the three components of a vector, or coordinates of a point."""
    return Sequence(_components(session, "comp_XYZ", thing, frame))


def comp(session: Session, which: Value, thing: Value, frame: Value | None = None) -> Value:
    """comp('X', obj [, T]): a component; 'Y', 'Z', or 'XYZ' for the sequence of all."""
    name = which.text if isinstance(which, String) else str(which)
    found = _components(session, "comp", thing, frame)
    if not name or any(letter not in "XYZ" for letter in name.upper()):
        raise WorksheetError(f"comp: the component {name}; expected 'X', 'Y', 'Z' or 'XYZ'")
    parts = tuple(found["XYZ".index(letter)] for letter in name.upper())
    return parts[0] if len(parts) == 1 else Sequence(parts)


# --- velocities ---


def velocity(session: Session, thing: Value, frame: Value | None = None) -> Value:
    """velocity(P [, T]): the velocity of a point, or the rate of a vector, as seen from a frame and in its axes."""
    return _rate(session, "velocity", thing, frame)


def acceleration(session: Session, thing: Value, frame: Value | None = None) -> Value:
    """acceleration(P [, T]): the acceleration of a point as seen from a frame and in its axes."""
    return _rate(session, "acceleration", thing, frame)


_RATES = {"velocity": velocity_of, "acceleration": acceleration_of}


def _rate(session: Session, where: str, thing: Value, frame: Value | None) -> Value:
    reader = Reader(session, where)
    table = session.resolve(thing)
    seen = reader.vector(table) if kind_of(table) in {"VECTOR", "FORCE", "TORQUE"} else reader.point(thing)
    if frame is None or _is_word(frame):
        return table_of_vector(session, _RATES[where](seen, reader.root))
    observer = reader.frame(frame)
    return table_of_vector(session, _RATES[where](seen, observer), _named(session, reader.frame_value(frame)))


def _is_word(value: Value) -> bool:
    """Return whether an argument is the word 'absolute' of old releases."""
    return isinstance(value, String) or (isinstance(value, Expr) and value.kind == "symbol")


def angular_velocity(session: Session, frame: Value, other: Value | None = None) -> Value:
    """angular_velocity(T): the angular velocity of a frame, in its own axes; angular_velocity(T, S): relative to S."""
    reader = Reader(session, "angular_velocity")
    axes = reader.frame(frame)
    found = spin_of(axes)
    if other is not None and not _is_word(other):
        found = found - spin_of(reader.frame(other))
    return table_of_vector(session, found, _named(session, reader.frame_value(frame)))


def frame_frozen_velocity(session: Session, point: Value, frame: Value) -> Value:
    """frame_frozen_velocity(P, T): the velocity of the material point of a frame that coincides with a point."""
    reader = Reader(session, "frame_frozen_velocity")
    with derivation(order=ENERGY):
        found = frozen_velocity(reader.point(point), reader.frame(frame))
    return table_of_vector(session, found)


def center_of_mass(session: Session, body: Value) -> Value:
    """CoM(body): the centre of mass of a body."""
    table = Reader(session, "CoM").object(body, "BODY")
    frame = get(table, "frame")
    return origin(session, frame if frame is not None else table)


COMMANDS: dict[str, Command] = {
    "make_POINT": make_POINT,
    "make_VECTOR": make_VECTOR,
    "join_points": join_points,
    "origin": origin,
    "CoM": center_of_mass,
    "uvec_X": uvec_X,
    "uvec_Y": uvec_Y,
    "uvec_Z": uvec_Z,
    "project": project,
    "dot_prod": dot_prod,
    "cross_prod": cross_prod,
    "comp_X": comp_X,
    "comp_Y": comp_Y,
    "comp_Z": comp_Z,
    "comp_XYZ": comp_XYZ,
    "Xcomp": comp_X,
    "Ycomp": comp_Y,
    "Zcomp": comp_Z,
    "Comps": comp_XYZ,
    "comp": comp,
    "velocity": velocity,
    "acceleration": acceleration,
    "angular_velocity": angular_velocity,
    "frame_frozen_velocity": frame_frozen_velocity,
}
