"""The Carvallo-Whipple bicycle [Meijaard et al. 2007]: its wheels roll by conditions on velocities.

x forward, y right, z down; the place of the rear contact, yaw, lean and pitch, the steering angle and two wheel angles.
"""

from __future__ import annotations

from typing import NamedTuple

from symbody import (
    Body,
    Constraint,
    Equations,
    Expr,
    System,
    Torque,
    Vector,
    angular_velocity,
    center_of_mass,
    cross,
    functions_of_time,
    ground,
    newton_euler,
    project,
    rotate,
    sqrt,
    symbols,
    translate,
    velocity,
)

NAMES = "w c lam g rR mR IRxx IRyy xB zB mB IBxx IByy IBzz IBxz xH zH mH IHxx IHyy IHzz IHxz rF mF IFxx IFyy"


class Bicycle(NamedTuple):
    """The equations of the bicycle, and what the test needs of them."""

    equations: Equations
    parameters: dict[str, Expr]
    coordinates: dict[str, Expr]
    torques: tuple[Expr, Expr]


def bicycle() -> Bicycle:
    """Return the full nonlinear model: 8 coordinates, and 5 constraints, one of them on positions."""
    p = dict(zip(NAMES.split(), symbols(NAMES), strict=True))
    q = {
        name: functions_of_time(name)
        for name in ["x", "y", "yaw", "lean", "pitch", "steer", "rear_angle", "front_angle"]
    }
    w, c, tilt, rear_radius, front_radius = (p[name] for name in ("w", "c", "lam", "rR", "rF"))
    lean_torque, steer_torque = functions_of_time("T_lean T_steer")

    leaned = translate(q["x"], q["y"], 0) * rotate("Z", q["yaw"]) * rotate("X", q["lean"])
    hub = leaned * translate(0, 0, -rear_radius)
    frame = hub * rotate("Y", q["pitch"]) * translate(0, 0, rear_radius)
    steering = frame * translate(w + c, 0, 0) * rotate("Y", tilt) * rotate("Z", q["steer"])
    fork = steering * rotate("Y", -tilt) * translate(-w - c, 0, 0)
    axle = fork * translate(w, 0, -front_radius)

    rear = Body(
        hub * rotate("Y", q["rear_angle"]), p["mR"], p["IRxx"], p["IRyy"], p["IRxx"], name="rear wheel"
    )
    front = Body(
        axle * rotate("Y", q["front_angle"]), p["mF"], p["IFxx"], p["IFyy"], p["IFxx"], name="front wheel"
    )
    rider = Body(
        frame * translate(p["xB"], 0, p["zB"]),
        p["mB"],
        p["IBxx"],
        p["IByy"],
        p["IBzz"],
        Cxz=-p["IBxz"],
        name="frame",
    )
    handle = Body(
        fork * translate(p["xH"], 0, p["zH"]),
        p["mH"],
        p["IHxx"],
        p["IHyy"],
        p["IHzz"],
        Cxz=-p["IHxz"],
        name="fork",
    )

    down = project(Vector(ground, 0, 0, 1), axle).components
    slope = sqrt(down[0] ** 2 + down[2] ** 2)
    lowest = Vector(axle, front_radius * down[0] / slope, 0, front_radius * down[2] / slope)
    touching = axle.pose.origin[2] + front_radius * slope
    rear_slip = _slip(rear, Vector(hub, 0, 0, rear_radius))
    front_slip = _slip(front, lowest)
    system = System(
        [rear, rider, handle, front],
        [
            Torque(leaned, lean_torque, 0, 0, on=rider),
            Torque(steering, 0, 0, steer_torque, on=handle, reaction=rider),
        ],
        list(q.values()),
        [
            Constraint(touching, "the front wheel touches the ground"),
            Constraint(rear_slip[0], "the rear wheel rolls"),
            Constraint(rear_slip[1], "the rear wheel doesn't slip sideways"),
            Constraint(front_slip[0], "the front wheel rolls"),
            Constraint(front_slip[1], "the front wheel doesn't slip sideways"),
        ],
        Vector(ground, 0, 0, p["g"]),
        name="bicycle",
    )
    return Bicycle(newton_euler(system), p, q, (lean_torque, steer_torque))


def _slip(wheel: Body, arm: Vector) -> tuple[Expr, ...]:
    """Return the velocity of the point of a wheel that touches the ground, in the axes of ground."""
    turning = cross(angular_velocity(wheel.frame), arm)
    return project(velocity(center_of_mass(wheel)) + turning, ground).components
