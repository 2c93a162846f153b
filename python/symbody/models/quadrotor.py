"""The quadrotor with a slung load."""

from __future__ import annotations

from symbody.geometry import Vector, ground, rotate, translate
from symbody.multibody import Body, Force, System, Torque
from symbody.symbolic import functions_of_time, symbols

from .classic_system import ClassicSystem


def quadrotor_with_slung_load() -> ClassicSystem:
    """Return a quadrotor in space from whose centre of mass a load hangs on a stiff cable without mass.

    Its angles are yaw psi, pitch theta and roll phi; alpha and beta are those of the cable, from the vertical. The
    inputs are the thrust f along the z axis of the quadrotor, and the torques M1, M2 and M3 about its axes. The numbers
    are those of the program that was published to the source.

    >>> from symbody import newton_euler
    >>> newton_euler(quadrotor_with_slung_load().system)
    Equations(8 equations of motion, 0 constraints, coordinates x, y, z, psi, theta, phi, alpha, beta)
    """
    M, m, l, Ix, Iy, Iz, g = symbols("M m l Ix Iy Iz g")
    coordinates = functions_of_time("x y z psi theta phi alpha beta")
    x, y, z, psi, theta, phi, alpha, beta = coordinates
    f, M1, M2, M3 = functions_of_time("f M1 M2 M3")
    center = translate(x, y, z)
    axes = center * rotate("Z", psi) * rotate("Y", theta) * rotate("X", phi)
    body = Body(axes, M, Ix, Iy, Iz, name="quadrotor")
    load = Body(center * rotate("X", alpha) * rotate("Y", beta) * translate(0, 0, -l), m, name="load")
    rotors = [
        Force(axes, 0, 0, f, at=body.center_of_mass, on=body, name="thrust"),
        Torque(axes, M1, M2, M3, on=body, name="rotors"),
    ]
    gravity = Vector(ground, 0, 0, -g)
    return ClassicSystem(
        System([body, load], rotors, coordinates, gravity=gravity, name="Quadrotor with a slung load"),
        "Sreenath, Lee & Kumar, Geometric control and differential flatness of a quadrotor UAV with a cable-suspended"
        " load, IEEE Conf. Decision and Control 2013, p. 2269",
        {M: 0.5, m: 0.087, l: 1.0, Ix: 2.32e-3, Iy: 2.32e-3, Iz: 4e-3, g: 9.81},
        {alpha: 0.2, beta: -0.1},
        {f: (0.5 + 0.087) * 9.81, M1: 0.0, M2: 0.0, M3: 0.0},
    )
