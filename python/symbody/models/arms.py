"""Robot arms in the plane and in space."""

from __future__ import annotations

from symbody.geometry import Vector, ground
from symbody.multibody import Link, assemble, motor, revolute
from symbody.multibody.joint.joint import Joint
from symbody.symbolic import functions_of_time, symbols
from symbody.symbolic.given.arguments import counted

from .classic_system import ClassicSystem
from .pendulums import check_count, indexed


def planar_arm(n: int = 2) -> ClassicSystem:
    """Return an arm of n links in a vertical plane, by the angles of its joints, level where they are zero.

    Link k has the length l_k and its centre of mass at lc_k; the inputs tau_k are the torques of the motors. The
    numbers are those of homogeneous rods of 1 kg and 1 m.

    >>> from symbody import newton_euler
    >>> newton_euler(planar_arm(3).system)
    Equations(3 equations of motion, 0 constraints, coordinates q1, q2, q3)
    """
    check_count("planar_arm", n)
    m, l, lc, I = indexed("m l lc I", n)
    g = symbols("g")
    q, tau = ([functions_of_time(f"{name}{k}") for k in range(1, n + 1)] for name in ("q", "tau"))
    links = [Link(f"link {k + 1}", m[k], Iz=I[k], center=(lc[k], 0, 0)) for k in range(n)]
    joints: list[Joint] = [revolute("joint_1", ground, links[0], coordinate=q[0])]
    joints += [
        revolute(f"joint_{k + 1}", links[k - 1], links[k], at=(l[k - 1], 0, 0), coordinate=q[k])
        for k in range(1, n)
    ]
    mechanism = assemble(joints)
    bodies = mechanism.bodies
    motors = [
        motor(q[k], tau[k], on=bodies[k], reaction=bodies[k - 1] if k else None, name=f"motor {k + 1}")
        for k in range(n)
    ]
    parameters = dict.fromkeys((*m, *l[: n - 1]), 1.0) | dict.fromkeys(lc, 0.5) | dict.fromkeys(I, 1 / 12)
    return ClassicSystem(
        mechanism.system(motors, gravity=Vector(ground, 0, -g, 0), name=f"Plane arm of {counted(n, 'link')}"),
        "Spong, The swing up control problem for the Acrobot, IEEE Control Systems Magazine 15 (1995), p. 49",
        parameters | {g: 9.81},
        {q[0]: -1.0},
        dict.fromkeys(tau, 0.0),
    )


def spatial_arm() -> ClassicSystem:
    """Return an elbow manipulator: a column that turns about the vertical, an upper arm, and a forearm.

    Angles of the arms are measured downwards from the level. The centres of mass of the arms are at r1 and r2, the
    upper arm has the length l1; tau1 to tau3 are the torques of the motors. The source has no numbers; these are
    typical of a small arm.

    >>> from symbody import newton_euler
    >>> newton_euler(spatial_arm().system).mass_matrix[2, 2]
    Ix3 + m3*r2**2
    """
    m2, m3, l0, l1, r1, r2, g = symbols("m2 m3 l0 l1 r1 r2 g")
    Iz1, Ix2, Iy2, Iz2, Ix3, Iy3, Iz3 = symbols("Iz1 Ix2 Iy2 Iz2 Ix3 Iy3 Iz3")
    q1, q2, q3, tau1, tau2, tau3 = functions_of_time("theta1 theta2 theta3 tau1 tau2 tau3")
    column = Link("column", Iz=Iz1)
    upper = Link("upper arm", m2, Ix2, Iy2, Iz2, center=(0, r1, 0))
    fore = Link("forearm", m3, Ix3, Iy3, Iz3, center=(0, r2, 0))
    mechanism = assemble(
        [
            revolute("waist", ground, column, coordinate=q1),
            revolute("shoulder", column, upper, at=(0, 0, l0), axis="X", coordinate=-q2),
            revolute("elbow", upper, fore, at=(0, l1, 0), axis="X", coordinate=-q3),
        ]
    )
    one, two, three = (mechanism.body(link) for link in (column, upper, fore))
    motors = [
        motor(q1, tau1, on=one, name="motor 1"),
        motor(q2, tau2, on=two, reaction=one, name="motor 2"),
        motor(q3, tau3, on=three, reaction=two, name="motor 3"),
    ]
    return ClassicSystem(
        mechanism.system(motors, gravity=Vector(ground, 0, 0, -g), name="Elbow manipulator"),
        "Murray, Li & Sastry, A Mathematical Introduction to Robotic Manipulation, CRC 1994, example 4.3",
        {m2: 2.0, m3: 1.5, l0: 0.5, l1: 0.4, r1: 0.2, r2: 0.18, g: 9.81, Iz1: 0.02}
        | {Ix2: 0.027, Iy2: 0.001, Iz2: 0.027, Ix3: 0.016, Iy3: 0.0005, Iz3: 0.016},
        {q1: 0.3, q2: 0.4, q3: -0.5},
        {tau1: 0.0, tau2: 0.0, tau3: 0.0},
    )
