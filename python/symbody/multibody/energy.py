"""Energies of bodies and loads."""

from __future__ import annotations

from collections.abc import Collection, Iterable

from symbody.errors import ModelError
from symbody.geometry import Frame, Vector
from symbody.geometry.component.triple import Triple, is_null
from symbody.geometry.frame.frame_velocity import origin_velocity, spin, twist
from symbody.geometry.given.argument import checked
from symbody.geometry.motion.frame_motion import FrameMotion
from symbody.symbolic import ENERGY, Expr, are_small, cost, derivation, dot3, number, time_derivatives

from .body import Body
from .load import Load
from .selection import Objects, select, select_bodies
from .system import System


@checked(ModelError)
def kinetic_energy(objects: Objects) -> Expr:
    """Return the kinetic energy: ``T = 1/2 m v_G . v_G + 1/2 w . J w``, summed over the bodies.

    >>> from symbody import Body, functions_of_time, rotate, symbols, translate
    >>> x, m = functions_of_time("x"), symbols("m")
    >>> kinetic_energy(Body(translate(x, 0, 0), m))
    m*x'**2/2
    >>> y, phi = functions_of_time("y phi")
    >>> kinetic_energy(Body(translate(x, y, 0) * rotate("Z", phi), m))
    m*(x'**2 + y'**2)/2
    """
    bodies = select_bodies(objects, "kinetic_energy").bodies
    with derivation(order=ENERGY):
        return sum(
            (_energy_at(body, body.frame, _shortest_velocity(body.frame)) for body in bodies), start=number(0)
        )


def kinetic_energy_in_own_axes(bodies: Iterable[Body]) -> Expr:
    """Return the kinetic energy with velocities in the axes of the bodies, as derivations have them."""
    with derivation(order=ENERGY):
        return sum((kinetic_energy_at(body, body.frame) for body in bodies), start=number(0))


def kinetic_energy_at(body: Body, frame: Frame) -> Expr:
    """Return the kinetic energy of a body that moves with a frame: its own, or one with other velocities."""
    return _energy_at(body, frame, origin_velocity(frame).components)


def _shortest_velocity(frame: Frame) -> Triple:
    """Return the velocity of the origin in the axes of the frame or, if it is shorter there, in others.

    These are the axes before rotations about the origin, as that of a wheel on its axle, and those of the ground. Small
    variables are known to the first order in places, which is not enough for energies in axes of the ground.
    """
    velocities = [origin_velocity(frame).components]
    link, is_known = frame, frame.is_rigid and not frame.coordinate_rates and not are_small(frame.pose.origin)
    while is_known and link.motion is not None and link.parent is not None and _turns(link.motion):
        link = link.parent
        velocities.append(twist(link).linear)
    if is_known and frame.ancestor.carrier is None:
        x, y, z = time_derivatives(frame.pose.origin)
        velocities.append((x, y, z))
    return min(velocities, key=lambda velocity: cost(list(velocity)).total)


def _turns(motion: FrameMotion) -> bool:
    """Return whether a motion is a rotation about the origin."""
    return motion.twist is None and is_null(motion.displacement)


def _energy_at(body: Body, frame: Frame, velocity: Triple) -> Expr:
    """Return the kinetic energy of a body that moves with a frame whose origin has the velocity, in any axes."""
    twice = body.mass * dot3(velocity, velocity)
    if not body.is_particle:
        angular = spin(frame)
        twice += dot3(angular, body.spin_momentum(angular))
    return twice / 2


@checked(ModelError)
def gravitational_energy(objects: Objects, gravity: Vector | None = None) -> Expr:
    """Return the potential energy of weight: ``-m g . r_G``, summed over the bodies.

    Args:
        objects: a body, bodies, or a system.
        gravity: the acceleration; by default that of the system.

    Raises:
        ModelError: there is no gravity, or the bodies are attached to a moving master frame, whose height is unknown.

    >>> from symbody import Body, Vector, functions_of_time, gravitational_energy, ground, symbols, translate
    >>> z, (m, g) = functions_of_time("z"), symbols("m g")
    >>> gravitational_energy(Body(translate(0, 0, z), m), Vector(ground, 0, 0, -g))
    g*m*z
    """
    selection = select_bodies(objects, "gravitational_energy", gravity)
    if selection.gravity is None:
        raise ModelError(
            "gravitational_energy: no gravity is given; pass a vector such as Vector(ground, 0, 0, -g)"
        )
    if selection.root.carrier is not None:
        raise ModelError(
            f"gravitational_energy: the bodies are attached to {selection.root}, whose place is unknown; give the "
            "moving frame a pose"
        )
    with derivation(order=ENERGY):
        g = selection.gravity.projected(selection.root).components
        return sum((_weight_energy(body, g) for body in selection.bodies), start=number(0))


def _weight_energy(body: Body, g: tuple[Expr, Expr, Expr]) -> Expr:
    return -(body.mass * dot3(g, body.frame.pose.origin))


@checked(ModelError)
def potential_energy(objects: Objects, gravity: Vector | None = None) -> Expr:
    """Return the potential energy of weight, where there is gravity, and of loads that have one, such as springs.

    Args:
        objects: a system, a body, a load, or a set or list of bodies and loads. The energy of a load counts if all
            bodies on which it acts are among the objects, or if there are loads alone.
        gravity: the acceleration of weight; by default that of the system, if it has one.

    >>> from symbody import Body, functions_of_time, ground, origin, spring, symbols, translate
    >>> x, k = functions_of_time("x"), symbols("k")
    >>> slider = Body(translate(x, 0, 0), 1)
    >>> potential_energy([slider, spring(slider.center_of_mass, origin(ground), k, on=slider)])
    k*x**2/2
    """
    selection = select(objects, "potential_energy", gravity)
    with derivation(order=ENERGY):
        total = sum(potentials(selection.loads, selection.bodies), start=number(0))
        if selection.gravity is not None and selection.bodies:
            total += gravitational_energy(selection.bodies, selection.gravity)
    return total


def potentials(loads: Iterable[Load], bodies: Collection[Body]) -> tuple[Expr, ...]:
    """Return the potential energies of loads that have one, and that act on given bodies alone, if any are given."""
    members = {*bodies}
    inside = (load for load in loads if not members or all(action.body in members for action in load.actions))
    return tuple(load.potential for load in inside if load.potential is not None)


def known_potential(system: System) -> Expr | None:
    """Return the potential energy of a system: of loads, and of weight where the height is known; None without any."""
    gravity = system.gravity if system.root.carrier is None else None
    if gravity is None and not potentials(system.loads, system.bodies):
        return None
    return potential_energy([*system.bodies, *system.loads], gravity)


@checked(ModelError)
def mechanical_energy(objects: Objects, gravity: Vector | None = None) -> Expr:
    """Return the kinetic energy, plus the potential energies of weight, where there is gravity, and of loads.

    Args:
        objects: bodies and loads, or a system.
        gravity: the acceleration of weight; by default that of the system, if it has one.

    >>> from symbody import Body, Vector, functions_of_time, ground, mechanical_energy, symbols, translate
    >>> z, (m, g) = functions_of_time("z"), symbols("m g")
    >>> mechanical_energy(Body(translate(0, 0, z), m), Vector(ground, 0, 0, -g))
    m*z'**2/2 + g*m*z
    """
    selection = select_bodies(objects, "mechanical_energy", gravity)
    parts: list[Body | Load] = [*selection.bodies, *selection.loads]
    return kinetic_energy(parts) + potential_energy(parts, selection.gravity)
