"""Bodies that roll: the thin disc and the rattleback."""

from __future__ import annotations

from symbody.geometry import (
    Vector,
    angular_velocity,
    cross,
    ground,
    origin,
    project,
    rotate,
    translate,
    velocity,
)
from symbody.multibody import Body, Constraint, Link, System, assemble, rolling
from symbody.symbolic import functions_of_time, sqrt, symbols, time_derivative

from .classic_system import ClassicSystem
from .hub import HUB_SPEEDS, hub


def rolling_disc(*, thin: bool = True, quasi_velocities: bool = False) -> ClassicSystem:
    """Return a thin disc that rolls on a level plane: its contact at x and y, heading psi, lean theta and spin phi.

    A wheel that is not a thin disc has the moments of inertia A about a diameter and C about its axis as parameters.
    With quasi-velocities, it rolls by the choice of its speeds, which are those of yaw, lean and spin, and there are no
    constraints. The numbers are typical, and not from the source.

    >>> from symbody import newton_euler
    >>> newton_euler(rolling_disc().system)
    Equations(5 equations of motion, 2 constraints, coordinates x, y, psi, theta, phi)
    >>> newton_euler(rolling_disc(quasi_velocities=True).system).speeds
    (omega_yaw, omega_lean, phi')
    """
    m, r, A, C, g = symbols("m r A C g")
    coordinates = functions_of_time("x y psi theta phi")
    *pose, phi = coordinates
    _, _, psi, theta = pose
    across, along = (m * r**2 / 4, m * r**2 / 2) if thin else (A, C)
    inertia = (m, across, along, across)
    weight, name, turning = Vector(ground, 0, 0, -g), "Rolling disc", time_derivative(psi)
    if quasi_velocities:
        disc = Body(hub(pose, r, time_derivative(phi)) * rotate("Y", phi), *inertia, name="disc")
        system = System([disc], (), [phi], gravity=weight, speeds=HUB_SPEEDS, name=name)
        turning, _ = HUB_SPEEDS
    else:
        contact = rolling("contact", ground, Link("disc", *inertia), radius=r, coordinates=coordinates)
        system = assemble([contact]).system(gravity=weight, name=name)
    return ClassicSystem(
        system,
        "Neimark & Fufaev, Dynamics of Nonholonomic Systems, AMS 1972",
        {m: 2.0, r: 0.25, g: 9.81} | ({} if thin else {A: 0.04, C: 0.08}),
        {theta: 0.3, turning: 2.0, time_derivative(phi): 5.2},
    )


def rattleback() -> ClassicSystem:
    """Return a rattleback: an ellipsoid that rolls on a plane, whose principal axes of inertia are turned a little.

    The half axes are a, b and c, and the centre of mass is h below the centre of the ellipsoid, which is at x and y. A,
    B and C are the moments of inertia and D the entry x-y of the inertia tensor in the axes of the source, where z
    points downwards and y to the other side; here z is upwards. alpha is the heading, beta the roll about the long axis
    x, and gamma the pitch. Seen from above, it spins well clockwise, alpha' < 0; counterclockwise, it begins to rattle,
    and turns back. The numbers are those of the source.

    >>> from symbody import newton_euler
    >>> newton_euler(rattleback().system)
    Equations(5 equations of motion, 2 constraints, coordinates x, y, alpha, beta, gamma)
    """
    M, a, b, c, h, A, B, C, D, g = symbols("M a b c h A B C D g")
    x, y, alpha, beta, gamma = coordinates = functions_of_time("x y alpha beta gamma")
    turned = rotate("Z", alpha) * rotate("X", beta) * rotate("Y", gamma)
    nx, ny, nz = project(Vector(ground, 0, 0, 1), turned).components
    height = sqrt(a**2 * nx**2 + b**2 * ny**2 + c**2 * nz**2)
    frame = translate(x, y, height) * turned
    body = Body(frame * translate(0, 0, -h), M, A, B, C, Cxy=D, name="rattleback")
    lowest = Vector(frame, -(a**2) * nx / height, -(b**2) * ny / height, -(c**2) * nz / height)
    slip = project(velocity(origin(frame)) + cross(angular_velocity(frame), lowest), ground).components
    rolling_conditions = [Constraint(slip[0], "no slip along x"), Constraint(slip[1], "no slip along y")]
    return ClassicSystem(
        System([body], (), coordinates, rolling_conditions, Vector(ground, 0, 0, -g), name="Rattleback"),
        "Kane & Levinson, Realistic mathematical modeling of the rattleback, Int. J. Non-Linear Mechanics 17 (1982),"
        " p. 175, without resistance",
        {a: 0.2, b: 0.03, c: 0.02, h: 0.01, M: 1.0, A: 2e-4, B: 1.6e-3, C: 1.7e-3, D: -2e-5, g: 9.81},
        {beta: 0.5 * 0.017453292519943295, gamma: -0.5 * 0.017453292519943295, time_derivative(alpha): 5.0},
    )
