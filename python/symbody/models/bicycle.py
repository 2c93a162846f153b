"""The Carvallo-Whipple bicycle."""

from __future__ import annotations

from collections.abc import Mapping
from math import pi as half_turn

from symbody.geometry import Vector, ground, rotate, translate
from symbody.multibody import Link, System, Torque, assemble, revolute, rolling
from symbody.symbolic import Expr, functions_of_time, pi, symbols, time_derivative

from .bicycle_by_speeds import bicycle_by_speeds
from .classic_system import ClassicSystem
from .hub import HUB_SPEEDS

_NUMBERS = {
    "w": 1.02,
    "c": 0.08,
    "lam": half_turn / 10,
    "g": 9.81,
    "rR": 0.3,
    "mR": 2.0,
    "IRxx": 0.0603,
    "IRyy": 0.12,
    "xB": 0.3,
    "zB": -0.9,
    "mB": 85.0,
    "IBxx": 9.2,
    "IByy": 11.0,
    "IBzz": 2.8,
    "IBxz": 2.4,
    "xH": 0.9,
    "zH": -0.7,
    "mH": 4.0,
    "IHxx": 0.05892,
    "IHyy": 0.06,
    "IHzz": 0.00708,
    "IHxz": -0.00756,
    "rF": 0.35,
    "mF": 3.0,
    "IFxx": 0.1405,
    "IFyy": 0.28,
}


def bicycle(*, quasi_velocities: bool = False) -> ClassicSystem:
    """Return the Carvallo-Whipple bicycle with its rider: a frame, a fork, and two wheels that roll.

    x points forward, y to the right and z down. The coordinates are the contact of the rear wheel, yaw, lean and pitch
    of the frame, the steering angle, and the angles of the wheels. The rear wheel opens the tree, the front wheel
    closes it. The inputs are torques for the lean and the steering. Upright, it is stable between 4.292 and 6.024 m/s.
    The numbers are those of the benchmark in the source.

    With quasi-velocities, the rear wheel rolls by the choice of its speeds, those of yaw, lean and spin. Three
    constraints are left, which hold the contact point of the front wheel, its height by the velocity too.

    >>> from symbody import newton_euler
    >>> len(newton_euler(bicycle().system).constraints)
    5
    >>> len(newton_euler(bicycle(quasi_velocities=True).system).constraints)
    3
    """
    p = {name: symbols(name) for name in _NUMBERS}
    names = "x y yaw lean steer rear_angle front_angle T_lean T_steer"
    x, y, yaw, lean, steer, rear_angle, front_angle, lean_torque, steer_torque = functions_of_time(names)
    system = bicycle_by_speeds(p) if quasi_velocities else _by_joints(p)
    leaning = HUB_SPEEDS[1] if quasi_velocities else time_derivative(lean)
    speed = 4.6
    return ClassicSystem(
        system,
        "Meijaard, Papadopoulos, Ruina & Schwab, Linearized dynamics equations for the balance and steer of a bicycle,"
        " Proc. R. Soc. A 463 (2007), p. 1955",
        {p[name]: value for name, value in _NUMBERS.items()},
        dict.fromkeys((x, y, yaw, lean, steer, rear_angle, front_angle), 0.0)
        | {time_derivative(rear_angle): -speed / 0.3, leaning: 0.5, time_derivative(steer): 0.0},
        {lean_torque: 0.0, steer_torque: 0.0},
    )


def _by_joints(p: Mapping[str, Expr]) -> System:
    """Return the bicycle whose wheels are rolling joints, by the values of its parameters."""
    w, c, tilt, rear_radius, front_radius = (p[name] for name in ("w", "c", "lam", "rR", "rF"))
    x, y, yaw, lean, pitch, steer, rear_angle, front_angle, lean_torque, steer_torque = functions_of_time(
        "x y yaw lean pitch steer rear_angle front_angle T_lean T_steer"
    )
    rear = Link("rear wheel", p["mR"], p["IRxx"], p["IRyy"], p["IRxx"])
    frame, fork = (
        Link(
            name,
            p[f"m{part}"],
            p[f"I{part}xx"],
            p[f"I{part}yy"],
            p[f"I{part}zz"],
            Cxz=-p[f"I{part}xz"],
            center=(p[f"x{part}"], 0, p[f"z{part}"]),
        )
        for name, part in (("frame", "B"), ("fork", "H"))
    )
    front = Link("front wheel", p["mF"], p["IFxx"], p["IFyy"], p["IFxx"])
    up = rotate("X", pi)  # z of a rolling joint points up: y, the yaw and the angle of the wheel change signs
    head = translate(w + c, 0, 0) * rotate("Y", tilt)
    contact = [x, -y, -yaw, lean, -rear_angle]
    made = assemble(
        [
            rolling("R", ground, rear, radius=rear_radius, at=up, to=up, coordinates=contact),
            revolute("hub", rear, frame, to=(0, 0, -rear_radius), axis="Y", coordinate=pitch - rear_angle),
            revolute("head", frame, fork, at=head, to=head, coordinate=steer),
            revolute("axle", fork, front, at=(w, 0, -front_radius), axis="Y", coordinate=front_angle),
            rolling("F", ground, front, radius=front_radius, at=up, to=up),
        ]
    )
    leaned = translate(x, y, 0) * rotate("Z", yaw) * rotate("X", lean)
    steering = made.joint("head").parent_side
    loads = [
        Torque(leaned, lean_torque, 0, 0, on=made.body(frame), name="lean torque"),
        Torque(
            steering,
            0,
            0,
            steer_torque,
            on=made.body(fork),
            reaction=made.body(frame),
            name="steering torque",
        ),
    ]
    weight = Vector(ground, 0, 0, p["g"])
    return made.system(loads, gravity=weight, inputs=[lean_torque, steer_torque], name="Bicycle")
