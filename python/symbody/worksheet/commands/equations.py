"""Commands of equations of motion."""

from __future__ import annotations

from typing import TYPE_CHECKING

from symbody.deferred import Deferred
from symbody.errors import WorksheetError
from symbody.geometry import Frame, Point
from symbody.symbolic import ENERGY, Expr, derivation, number, small, t
from symbody.worksheet.commands.bodies import gravity
from symbody.worksheet.evaluation.entrywise import depends_on
from symbody.worksheet.evaluation.session import Command, Session
from symbody.worksheet.mechanics import frame_face
from symbody.worksheet.mechanics.modes import mechanics
from symbody.worksheet.mechanics.objects import Reader, described, kind_of, members, table_of_vector
from symbody.worksheet.mechanics.small_variables import result
from symbody.worksheet.values.value import Boolean, Listed, MapleSet, Sequence, Value

if TYPE_CHECKING:
    from symbody import dynamics, multibody
    from symbody.multibody import Body
else:
    dynamics = Deferred("symbody.dynamics")
    multibody = Deferred("symbody.multibody")

__all__ = ["COMMANDS"]


def newton_equations(session: Session, system: Value, *options: Value) -> Value:
    """newton_equations(system [, T]): m a - F - m g of bodies and forces, in the axes of the ground or of T."""
    reader = Reader(session, "newton_equations")
    bodies, loads = reader.bodies_and_loads(system)
    _check(reader, bodies)
    axes, shown, _ = _options(reader, options)
    return table_of_vector(
        session, dynamics.newton_equations([*bodies, *loads], axes, gravity=gravity(reader)), shown
    )


def euler_equations(session: Session, system: Value, *options: Value) -> Value:
    """euler_equations(system [, A [, T]]): dH_A/dt - M_A of bodies and forces, about their centre of mass or A.

    About a moving point A, it is the sum of AG x m a_G + dH_G/dt, less the moments. Of bodies without mass, and without
    a point, the moments are about the origin of the first body's frame.
    """
    reader = Reader(session, "euler_equations")
    bodies, loads = reader.bodies_and_loads(system)
    _check(reader, bodies)
    axes, shown, about = _options(reader, options)
    with derivation(order=ENERGY):
        if about is None and sum((body.mass for body in bodies), start=number(0)).is_zero:
            about = bodies[0].center_of_mass
    return table_of_vector(
        session, dynamics.euler_equations([*bodies, *loads], about, axes, gravity=gravity(reader)), shown
    )


def _check(reader: Reader, bodies: list[Body]) -> None:
    if not bodies:
        raise WorksheetError(f"{reader.where}: no body in the system; expected a set such as {{body1, F1}}")


def _options(reader: Reader, options: tuple[Value, ...]) -> tuple[Frame | None, Value | None, Point | None]:
    """Return the frame of the components, as a chain and as the sheet has it, and the point of the moments."""
    axes, shown, about = None, None, None
    for option in options:
        found = reader.session.resolve(option)
        if frame_face.is_frame(found):
            axes, shown = reader.frame(option), option
        elif kind_of(found) in {"POINT", "BODY"}:
            about = reader.point(option)
        elif not (isinstance(found, Boolean) or found == Sequence(()) or isinstance(found, Expr)):
            raise WorksheetError(f"{reader.where}: {described(found)}; expected a point or a frame")
    return axes, shown, about


def generalized_force(session: Session, loads: Value, variables: Value) -> Value:
    """generalized_force(F, q): the virtual work of forces and torques per unit change of q; a list for a list of q."""
    reader = Reader(session, "generalized_force")
    found = [load for item in members(session, loads) if (load := reader.load(item)) is not None]
    several = reader.session.resolve(variables)
    items = several.items if isinstance(several, Listed | MapleSet | Sequence) else (several,)
    coordinates = [_coordinate(reader, item) for item in items]
    forces = result(mechanics(session), dynamics.generalized_force(found, coordinates))
    return Listed(forces) if isinstance(several, Listed | MapleSet | Sequence) else forces[0]


def _coordinate(reader: Reader, value: Value) -> Expr:
    """Return a coordinate with its mark, if it is small."""
    if not isinstance(value, Expr) or value.is_number:
        raise WorksheetError(f"{reader.where}: {described(value)}; expected a coordinate, such as q or x(t)")
    return small(value) if value in mechanics(reader.session).small else value


def _function_of_time(reader: Reader, value: Value) -> Expr:
    """Return a coordinate of Lagrange's equations, which has a rate."""
    found = _coordinate(reader, value)
    if found.kind == "symbol":
        raise WorksheetError(
            f"{reader.where}: {found} is not a function of time; write {found}(t) here, and in the frames that it moves"
        )
    return found


def lagrange(session: Session, energy: Value, variable: Value, time: Value | None = None) -> Value:
    """lagrange(L, q(t), t): d/dt dL/dq' - dL/dq; the equation of motion subtracts the generalized force."""
    del time
    reader = Reader(session, "lagrange")
    L, several = reader.scalar(energy), session.resolve(variable)
    _check_known(session, L)
    items = several.items if isinstance(several, Listed | MapleSet | Sequence) else (variable,)
    found = [dynamics.lagrange(L, _function_of_time(reader, item)) for item in items]
    equations = result(mechanics(session), found)
    return Listed(equations) if isinstance(several, Listed | MapleSet | Sequence) else equations[0]


def _check_known(session: Session, energy: Expr) -> None:
    """Raise what the user should read if an energy holds a call that moves, and whose derivative is not known."""
    for leaf in sorted(energy.free_symbols, key=str):
        call = session.opaque.get(leaf.name)
        if call is not None and depends_on(call, t):
            raise WorksheetError(
                f"lagrange: {session.text(call)[:60]} depends on the motion and isn't worked out; expected an energy "
                "whose derivatives are known"
            )


def lagrange_equations(session: Session, system: Value, variables: Value, *options: Value) -> Value:
    """lagrange_equations(system, [q, ...]): d/dt dT/dq' - dT/dq - Q for each coordinate, with the weight in Q."""
    del options
    reader = Reader(session, "lagrange_equations")
    bodies, loads = reader.bodies_and_loads(system)
    _check(reader, bodies)
    unhung = Reader(session, "lagrange_equations", hung=False)
    with derivation(order=ENERGY):
        L = multibody.kinetic_energy(bodies)
        g = gravity(unhung)
        if g is not None:
            L -= multibody.gravitational_energy(unhung.bodies_and_loads(_only_bodies(session, system))[0], g)
    items = members(session, variables)
    coordinates = [_function_of_time(reader, item) for item in items]
    forces = dynamics.generalized_force(loads, coordinates)
    modes = mechanics(session)
    found = [
        result(modes, [dynamics.lagrange(L, q) - Q])[0] for q, Q in zip(coordinates, forces, strict=True)
    ]
    return Listed(tuple(found))


def _only_bodies(session: Session, system: Value) -> Value:
    return Listed(
        tuple(item for item in members(session, system) if kind_of(session.resolve(item)) == "BODY")
    )


COMMANDS: dict[str, Command] = {
    "newton_equations": newton_equations,
    "euler_equations": euler_equations,
    "generalized_force": generalized_force,
    "lagrange": lagrange,
    "lagrange_equations": lagrange_equations,
}
