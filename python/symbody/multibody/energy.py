"""Energies of bodies."""

from __future__ import annotations

from symbody.errors import ModelError
from symbody.geometry import Frame, Vector
from symbody.geometry.frame.frame_velocity import origin_velocity, spin
from symbody.geometry.given.argument import checked
from symbody.symbolic import Expr, derivation, dot3, number

from .body import Body
from .selection import Objects, select_bodies


@checked(ModelError)
def kinetic_energy(objects: Objects) -> Expr:
    """Return the kinetic energy: ``T = 1/2 m v_G . v_G + 1/2 w . J w``, summed over the bodies.

    >>> from symbody import Body, functions_of_time, symbols, translate
    >>> x, m = functions_of_time("x"), symbols("m")
    >>> kinetic_energy(Body(translate(x, 0, 0), m))
    m*x'**2/2
    """
    with derivation():
        return sum(
            (kinetic_energy_at(body, body.frame) for body in select_bodies(objects, "kinetic_energy").bodies),
            start=number(0),
        )


def kinetic_energy_at(body: Body, frame: Frame) -> Expr:
    """Return the kinetic energy of a body that moves with a frame: its own, or one with other velocities."""
    velocity = origin_velocity(frame).components
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
    with derivation():
        g = selection.gravity.projected(selection.root).components
        return sum((_weight_energy(body, g) for body in selection.bodies), start=number(0))


def _weight_energy(body: Body, g: tuple[Expr, Expr, Expr]) -> Expr:
    return -(body.mass * dot3(g, body.frame.pose.origin))


@checked(ModelError)
def mechanical_energy(objects: Objects, gravity: Vector | None = None) -> Expr:
    """Return the kinetic energy, plus the potential energy of weight where there is gravity.

    Args:
        objects: a body, bodies, or a system.
        gravity: the acceleration of weight; by default that of the system, if it has one.

    >>> from symbody import Body, Vector, functions_of_time, ground, mechanical_energy, symbols, translate
    >>> z, (m, g) = functions_of_time("z"), symbols("m g")
    >>> mechanical_energy(Body(translate(0, 0, z), m), Vector(ground, 0, 0, -g))
    m*z'**2/2 + g*m*z
    """
    selection = select_bodies(objects, "mechanical_energy", gravity)
    kinetic = kinetic_energy(selection.bodies)
    return (
        kinetic
        if selection.gravity is None
        else kinetic + gravitational_energy(selection.bodies, selection.gravity)
    )
