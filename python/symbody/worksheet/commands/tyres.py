"""The tyre of MBSymba's add-on: contact, slip velocities, and the forces at the centre of the wheel.

The z axis of the road points downwards, as in the vehicle axes of the add-on: the contact is at ``(0, y, z)`` in the
axes of the tyre, whose y axis is that of the spin.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from symbody.deferred import Deferred
from symbody.geometry import (
    Frame,
    Point,
    Vector,
    cross,
    dot,
    frozen_velocity,
    ground,
    origin,
    rotate,
    translate,
)
from symbody.geometry.frame.frame import Rows4
from symbody.geometry.motion.principal_rotation import Rotation
from symbody.symbolic import ENERGY, Expr, atan2, derivation, number, pi, subs, symbol
from symbody.worksheet.evaluation.session import Command, Session
from symbody.worksheet.mechanics import frame_face
from symbody.worksheet.mechanics.modes import mechanics
from symbody.worksheet.mechanics.objects import Reader, column, face_of, get, made, members, put, written
from symbody.worksheet.mechanics.small_variables import left, result
from symbody.worksheet.values.value import Listed, Relation, Sequence, Value

if TYPE_CHECKING:
    from symbody import multibody
    from symbody.multibody import Body, TireKinematics, TireShape
else:
    multibody = Deferred("symbody.multibody")

__all__ = ["COMMANDS", "tyre_axes"]

_DEPTH = symbol("_depth")
"""How far below the origin of a moving master frame the road is."""


def make_TIRE(session: Session, wheel: Value, *arguments: Value) -> Value:
    """make_TIRE(wheel, y, z, spin_def, y_def, z_def, FX, FY, FZ, MX, MY, MZ, TR): a tyre on a road with z downwards.

    The profiles y and z of the cross section and the deformations place the contact; forces and moments are along the
    axes of the contact. Everything but the wheel is zero by default, and the road is the master frame.
    """
    reader = Reader(session, "make_TIRE")
    reader.object(wheel, "BODY")
    scalars = [session.current(each) for each in arguments[:11]]
    scalars += [number(0)] * (11 - len(scalars))
    y, z, spin, y_def, z_def, *loads = scalars
    if isinstance(z, Expr) and isinstance(z_def, Expr) and (z + z_def).is_zero:
        session.notice(
            "make_TIRE: the radius z + z_def is zero, so that the tyre touches the road at the centre of the wheel; "
            "expected the distance from there to the contact, such as make_TIRE(wheel, 0, R, 0, 0, 0, X, Y, -N)"
        )
    road = arguments[11] if len(arguments) > 11 else frame_face.ground_face(mechanics(session))
    table = made(
        "TIRE",
        acting=wheel,
        shape=Listed((number(0), y, z, number(0))),
        compliance=Listed((spin, y_def, z_def, number(0))),
        FORCE=Listed((*loads[:3], number(0))),
        TORQUE=Listed((*loads[3:], number(0))),
        road=road,
    )
    contact = _contact(reader, table)
    put(table, "frame", face_of(session, contact.axes))
    ahead = contact.kinematics.longitudinal.projected(reader.frame(road)).components
    angles = left(mechanics(session), [atan2(ahead[1], ahead[0]), contact.kinematics.camber])
    names = symbol("yaw"), symbol("camber")
    put(table, "angles", Listed(tuple(Relation("=", n, a) for n, a in zip(names, angles, strict=True))))
    return table


@dataclass(frozen=True)
class _Contact:
    """A tyre in the modes of a session.

    Attributes:
        wheel: the body.
        axes: the frame of the tyre: its origin is that of the wheel, y the spin axis, z towards the road.
        place: the contact.
        kinematics: how the wheel moves there; lateral is to the left, and normal upwards.
    """

    wheel: Body
    axes: Frame
    place: Point
    kinematics: TireKinematics


def _contact(reader: Reader, table: Value) -> _Contact:
    tire = reader.object(table, "TIRE")
    wheel = reader.body(get(tire, "acting") or number(0))
    road = reader.frame(get(tire, "road") or frame_face.ground_face(reader.modes))
    _, y, z, _ = (reader.scalar(each) for each in members(reader.session, get(tire, "shape") or number(0)))
    compliance = members(reader.session, get(tire, "compliance") or number(0))
    spin, y_def, z_def, _ = (reader.scalar(each) for each in compliance)
    # profiles are to the right and downwards here; in `tire_shape`, to the left and towards the road
    shape = multibody.tire_shape(-y, z, spin_deformation=-spin, y_deformation=-y_def, z_deformation=z_def)
    with derivation(order=ENERGY):
        axes, is_carrier = tyre_axes(wheel.frame, road)
        place = Point(axes, 0, y + y_def, z + z_def)
        depth = place.projected(road).coordinates[2]
        carrier = axes if is_carrier else None
        if road.ancestor.carrier is not None:  # the plane is at rest, at whatever depth the radius puts it
            found = _kinematics(wheel, shape, road * translate(0, 0, _DEPTH) * rotate("X", pi), carrier)
            moved: dict[str, Any] = {
                name: subs(each, {_DEPTH: depth}) for name, each in found._asdict().items()
            }
            return _Contact(wheel, axes, place, found._replace(**moved))
        surface = road * translate(0, 0, depth) * rotate("X", pi)
        return _Contact(wheel, axes, place, _kinematics(wheel, shape, surface, carrier))


def _kinematics(wheel: Body, shape: TireShape, surface: Frame, carrier: Frame | None) -> TireKinematics:
    """Return how a wheel moves on a plane at rest; the frame that shows where it is may go with the car."""
    found = multibody.tire_kinematics(wheel, shape, road=surface, carrier=carrier, spin_axis="-Y")
    if surface.ancestor.carrier is not None:
        return found
    base = frozen_velocity(found.contact, surface)
    along, across = dot(base, found.longitudinal), dot(base, found.lateral)
    return found._replace(VS=found.VS + along, VN=found.VN + across)


def tyre_axes(wheel: Frame, road: Frame) -> tuple[Frame, bool]:
    """Return the axes of a tyre: the wheel's without its spin, if x is along the road then; and whether it is so."""
    carrier = wheel
    while (
        isinstance(carrier.motion, Rotation) and carrier.motion.turn_axis == 1 and carrier.parent is not None
    ):
        carrier = carrier.parent
    if Vector(carrier, 1, 0, 0).projected(road).components[2].is_zero:
        return carrier, True
    found = _kinematics(multibody.Body(wheel, 0), multibody.tire_shape(0, 1), road * rotate("X", pi), None)
    j = Vector(wheel, 0, 1, 0)
    x = found.longitudinal
    columns = [each.projected(wheel.ancestor).components for each in (x, j, cross(x, j))]
    place = origin(wheel).projected(wheel.ancestor).coordinates
    rows: Rows4 = [[*(column[k] for column in columns), place[k]] for k in range(3)] + [[0, 0, 0, 1]]
    root = wheel.ancestor
    return (Frame(rows) if root == ground else root * Frame(rows)), False


def tire_forces(session: Session, tire: Value) -> Value:
    """tire_forces(tire): the force at the centre of the wheel, and the torque with the moment of the contact force."""
    reader = Reader(session, "tire_forces")
    table = reader.object(tire, "TIRE")
    contact = _contact(reader, tire)
    found, modes = contact.kinematics, mechanics(session)
    X, Y, Z, _ = (reader.scalar(each) for each in members(session, get(table, "FORCE") or number(0)))
    MX, MY, MZ, _ = (reader.scalar(each) for each in members(session, get(table, "TORQUE") or number(0)))
    with derivation(order=ENERGY):
        force = (found.longitudinal * X - found.lateral * Y - found.normal * Z).projected(contact.axes)
        moment = (found.longitudinal * MX - found.lateral * MY - found.normal * MZ).projected(contact.axes)
        lever = contact.place - contact.wheel.center_of_mass
        torque = moment + cross(lever.projected(contact.axes), force)
    acting, frame = get(table, "acting"), get(table, "frame")
    center = made("POINT", frame=_frame_of(session, acting), coords=column([number(0)] * 3, 1, modes))
    return Sequence(
        (
            written(session, "FORCE", force.components, frame or number(0), acting=acting, applied=center),
            written(session, "TORQUE", torque.components, frame or number(0), acting=acting),
        )
    )


def _frame_of(session: Session, body: Value | None) -> Value:
    return Reader(session, "tire_forces").frame_value(body or number(0))


def tire_kinematics(session: Session, tire: Value) -> Value:
    """tire_kinematics(tire): the contact point, the longitudinal, lateral and rolling speed (-omega R)."""
    reader = Reader(session, "tire_kinematics")
    table = reader.object(tire, "TIRE")
    contact = _contact(reader, tire)
    found, modes = contact.kinematics, mechanics(session)
    speeds: tuple[Expr, ...] = result(modes, (found.VS, -found.VN, found.VR))
    place = made(
        "POINT", frame=get(table, "frame"), coords=column(left(modes, contact.place.coordinates), 1, modes)
    )
    return Sequence((place, *speeds))


COMMANDS: dict[str, Command] = {
    "make_TIRE": make_TIRE,
    "tire_forces": tire_forces,
    "tire_kinematics": tire_kinematics,
}
