"""Tyres of motorcycles: wheels that touch the road and roll, whose forces need a length of road to build up."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from symbody.geometry import Vector, ground
from symbody.multibody import Body, Constraint, Force, System, Torque
from symbody.multibody.element.tire_kinematics import TireKinematics
from symbody.multibody.load import Load
from symbody.symbolic import Expr, number


class LaggingTyre(NamedTuple):
    """A wheel on the road: the loads of its tyre, their states, and the constraints of its contact."""

    loads: list[Force | Torque]
    states: dict[Expr, Expr]
    constraints: tuple[Constraint, Constraint]


class TyreLaw(NamedTuple):
    """The stiffnesses of a tyre in N/rad and N m/rad: of slip, which moves it aside, and of camber, which is a lean.

    Attributes:
        cornering: C1, by which the force opposes the slip.
        camber: C2, by which it pushes to the side of the lean.
        length: sigma, the relaxation length.
        load: the multiplier of the contact, where the stiffnesses are those per load.
        aligning: C3, by which the moment turns the wheel into its motion.
        twisting: C4, by which it turns the wheel to the side of the lean.
        overturning: C5, by which a moment along the wheel rights it.
    """

    cornering: Expr
    camber: Expr
    length: Expr
    load: Expr | None = None
    aligning: Expr = number(0)
    twisting: Expr = number(0)
    overturning: Expr = number(0)


def lagging_tyre(
    wheel: Body, contact: TireKinematics, force: Expr, law: TyreLaw, moment: Expr | None = None
) -> LaggingTyre:
    """Return the tyre of a wheel: ``sigma Y' = -VS (N C1 alpha + N C2 gamma + Y)``, and its moment M alike.

    ``sigma M' = VS (N C3 alpha - N C4 gamma - M)``, for motions forward, VS > 0. N is one without a load.

    Args:
        wheel: the wheel.
        contact: its contact.
        force: Y, the lateral force, a state.
        law: the stiffnesses.
        moment: M, the moment about the normal of the road, a state too.
    """
    N = number(1) if law.load is None else law.load
    name = wheel.name
    slip = N * (law.cornering * contact.VN + contact.VS * law.camber * contact.camber)
    states = {force: -(slip + contact.VS * force) / law.length}
    loads: list[Force | Torque] = [
        Force(force * contact.lateral, at=contact.contact, on=wheel, name=f"tyre of the {name}")
    ]
    if moment is not None:
        turn = N * (law.aligning * contact.VN - contact.VS * law.twisting * contact.camber)
        states[moment] = (turn - contact.VS * moment) / law.length
        loads.append(Torque(moment * contact.normal, on=wheel, name=f"moment of the {name}"))
    if not law.overturning.is_zero:
        righting = contact.longitudinal * (-law.overturning * contact.camber)
        loads.append(Torque(righting, on=wheel, name=f"overturning moment of the {name}"))
    constraints = (
        Constraint(-contact.deflection, f"the {name} touches the ground", multiplier=law.load),
        Constraint(contact.VS + contact.VR, f"the {name} rolls"),
    )
    return LaggingTyre(loads, states, constraints)


def system_on_tyres(
    bodies: Sequence[Body],
    loads: Sequence[Load],
    coordinates: Sequence[Expr],
    tyres: Sequence[LaggingTyre],
    g: Expr,
    name: str,
) -> System:
    """Return the system of a vehicle with the loads, states and constraints of its tyres; gravity is along -z.

    Args:
        bodies: the bodies, wheels included.
        loads: the loads, except those of the tyres.
        coordinates: the coordinates.
        tyres: the tyres.
        g: the acceleration of gravity.
        name: the name of the system.
    """
    return System(
        bodies,
        [*loads, *(load for tyre in tyres for load in tyre.loads)],
        coordinates,
        [constraint for tyre in tyres for constraint in tyre.constraints],
        Vector(ground, 0, 0, -g),
        states={state: rate for tyre in tyres for state, rate in tyre.states.items()},
        name=name,
    )
