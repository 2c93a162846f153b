"""Discs and wheels that roll."""

from __future__ import annotations

from collections.abc import Mapping

from symbody import (
    Body,
    Expr,
    Frame,
    System,
    Torque,
    Vector,
    cos,
    functions_of_time,
    ground,
    moving_frame,
    rotate,
    sin,
    subs,
    symbols,
    t,
    tan,
    translate,
)
from symbody.geometry.frame.frame_velocity import twist

from .classic import Classic

x, y, psi, theta, phi = functions_of_time("x y psi theta phi")


def rolling_frame(pose: Frame, rates: Mapping[Expr, Expr]) -> Frame:
    """Return the moving frame at a pose whose coordinates have these rates."""
    given = {coordinate.diff(t): rate for coordinate, rate in rates.items()}
    velocities = twist(pose)
    linear = [subs(component, given) for component in velocities.linear]
    angular = [subs(component, given) for component in velocities.angular]
    return moving_frame(*linear, *angular, pose=pose)


def rolling_disc() -> System:
    """A thin disc turns by psi, leans by theta and spins by phi; u1, u2 and u3 are along the axes that don't spin."""
    m, r, g = symbols("m r g")
    u1, u2, u3 = functions_of_time("u1 u2 u3")
    plane = translate(x, y, r * cos(theta)) * rotate("Z", psi) * rotate("X", theta)
    rolling = moving_frame(r * u2, -r * u1, 0, u1, u3 * tan(theta), u3, pose=plane)
    kinematics = System([Body(rolling, m)], speeds=[u1, u2, u3]).kinematics
    rates = {q: kinematics[q.diff(t)] for q in (x, y, psi, theta)}
    disc = rolling_frame(plane * rotate("Y", phi), {**rates, phi: u2 - u3 * tan(theta)})
    body = Body(disc, m, m * r**2 / 4, m * r**2 / 2, m * r**2 / 4)
    return System([body], speeds=[u1, u2, u3], gravity=Vector(ground, 0, 0, -g))


def two_wheeled_robot() -> System:
    """The base runs with v and turns with r; the wheels roll, and their motors stand on the body, which tilts."""
    mB, mW, I1, I2, I3, J, K, l, R, d, g = symbols("mB mW I1 I2 I3 J K l R d g")
    v, r, phiL, phiR, TL, TR = functions_of_time("v r phiL phiR TL TR")
    place = translate(x, y, 0) * rotate("Z", psi)
    rates = {x: v * cos(psi), y: v * sin(psi), psi: r}
    body = Body(rolling_frame(place, rates) * rotate("Y", theta) * translate(0, 0, l), mB, I1, I2, I3)
    wheels, motors = [], []
    for side, spin, torque in ((d / 2, phiL, TL), (-d / 2, phiR, TR)):
        pose = place * translate(0, side, 0) * rotate("Y", spin)
        wheel = Body(rolling_frame(pose, {**rates, spin: (v - side * r) / R}), mW, K, J, K)
        wheels.append(wheel)
        motors.append(Torque(wheel.frame, 0, torque, 0, on=wheel, reaction=body))
    return System([body, *wheels], motors, [theta], speeds=[v, r], gravity=Vector(ground, 0, 0, -g))


_D = "(I3 - I1 - mB*l**2)"

ROLLING = (
    Classic(
        "Rolling disc",
        "SymPy, documentation of physics.mechanics (a rolling disc with Kane's method), times the inertias",
        rolling_disc,
        (
            "5/4*m*r**2*u1' - 3/2*m*r**2*u2*u3 + 1/4*m*r**2*u3**2*tan(theta) - m*g*r*sin(theta) = 0",
            "3/2*m*r**2*u2' + m*r**2*u1*u3 = 0",
            "1/4*m*r**2*u3' + 1/2*m*r**2*u1*u2 - 1/4*m*r**2*u1*u3*tan(theta) = 0",
        ),
    ),
    Classic(
        "Two-wheeled robot",
        "Kim & Kwon, Int. J. Control, Automation and Systems 13 (2015), p. 926",
        two_wheeled_robot,
        (
            (
                "(mB + 2*mW + 2*J/R**2)*v' + mB*l*cos(theta)*theta'' - mB*l*sin(theta)*(theta'**2 + r**2)"
                " = (TL + TR)/R"
            ),
            (
                f"(I3 + 2*K + (mW + J/R**2)*d**2/2 - {_D}*sin(theta)**2)*r'"
                f" + (mB*l*v - 2*{_D}*cos(theta)*theta')*r*sin(theta) = (TR - TL)*d/(2*R)"
            ),
            (
                f"mB*l*cos(theta)*v' + (I2 + mB*l**2)*theta'' + {_D}*sin(theta)*cos(theta)*r**2"
                " - mB*g*l*sin(theta) = -(TL + TR)"
            ),
        ),
    ),
)
