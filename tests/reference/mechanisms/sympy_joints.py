"""Bodies on joints of the tests of SymPy's mechanics: prismatic, pin and spherical ones."""

from __future__ import annotations

from symbody import (
    Body,
    Force,
    Frame,
    System,
    Vector,
    angular_velocity,
    forward_dynamics,
    functions_of_time,
    ground,
    newton_euler,
    origin,
    pi,
    project,
    rotate,
    substitute,
    symbols,
    time_derivative,
    translate,
    velocity,
)

from .sympy_expectation import Derived
from .sympy_particles import parts


def sliding_masses() -> Derived:
    """Two equal bodies on prismatic joints, with springs and dampers that SymPy's test gives as interactions."""
    q1, q2, u1, u2 = functions_of_time("q1 q2 u1 u2")
    m, c1, c2, k1, k2 = symbols("m c1 c2 k1 k2")
    first = Body(translate(q1, 0, 0), m)
    second = Body(translate(q1 + q2, 0, 0), m)
    loads = [
        Force(ground, -k1 * q1 - c1 * u1, 0, 0, at=first.center_of_mass, on=first),
        Force(ground, -k2 * q2 - c2 * u2, 0, 0, at=second.center_of_mass, on=second, reaction=first),
    ]
    kinematics = {u1: time_derivative(q1), u2: time_derivative(q2)}
    equations = newton_euler(System([first, second], loads, [q1, q2], kinematics=kinematics))
    return Derived({"rhs": forward_dynamics(equations).accelerations})


def chaos_pendulum() -> Derived:
    """A plate that turns about a rod, which is a pendulum: two pin joints with axes at right angles."""
    theta, phi, omega, alpha = functions_of_time("theta phi omega alpha")
    mA, mB, lA, lB, IAxx, IBxx, IByy, IBzz, g = symbols("mA mB lA lB IAxx IBxx IByy IBzz g")
    arm = rotate("Y", theta)
    rod = Body(arm * translate(0, 0, lA), mA, IAxx, IAxx, 0)
    plate = Body(arm * translate(0, 0, lB) * rotate("Z", phi), mB, IBxx, IByy, IBzz)
    system = System(
        [rod, plate],
        (),
        [theta, phi],
        gravity=Vector(ground, 0, 0, g),
        kinematics={omega: time_derivative(theta), alpha: time_derivative(phi)},
    )
    return Derived(parts(newton_euler(system)))


def _between(parent: Frame, joint: Frame, child: Frame) -> Frame:
    """Return the frame of a child: a joint between intermediate frames of parent and child."""
    return parent * joint * child.inverse()


PARENT, CHILD = rotate("X", pi), rotate("Y", -pi / 2)
"""The intermediate frames of SymPy's tests, in the parent and in the child."""


def spherical_joint() -> Derived:
    """Three angles about body axes, between frames off the centres of mass."""
    q, u = functions_of_time("q0:3"), functions_of_time("u0:3")
    angles = rotate("X", q[0]) * rotate("Y", q[1]) * rotate("Z", q[2])
    child = _between(translate(1, 1, 0) * PARENT, angles, translate(0, -1, 1) * CHILD)
    speeds = {time_derivative(each): speed for each, speed in zip(q, u, strict=True)}
    spin = project(angular_velocity(child), child).components
    carried = project(velocity(origin(child)), child).components
    return Derived(
        {
            "N_R_A": [entry for row in child.pose.rows for entry in row],
            "N_w_A": substitute(spin, speeds),
            "N_v_Co": substitute(carried, speeds),
        }
    )


def pin_joint() -> Derived:
    """A pin about z of the parent, which is minus z of the intermediate frame."""
    q = functions_of_time("q")
    # SymPy aligns x of both intermediate frames with the axis of the pin; here it is -z of the parent's frame.
    child = _between(PARENT, rotate((0, 0, -1), q), CHILD)
    return Derived({"N_R_A": [entry for row in child.pose.rows for entry in row]})
