"""The Carvallo-Whipple bicycle by quasi-velocities: its rear wheel rolls by the choice of the speeds."""

from __future__ import annotations

from collections.abc import Mapping

from symbody.geometry import (
    Frame,
    Vector,
    angular_velocity,
    cross,
    ground,
    project,
    rotate,
    translate,
    velocity,
)
from symbody.multibody import Body, Constraint, System, Torque
from symbody.symbolic import Expr, functions_of_time, sqrt, time_derivative

from .hub import HUB_SPEEDS, hub

__all__ = ["bicycle_by_speeds"]


def bicycle_by_speeds(p: Mapping[str, Expr]) -> System:
    """Return the bicycle of `bicycle`, whose front wheel makes three constraints, by the values of its parameters."""
    names = "x y yaw lean pitch steer rear_angle front_angle T_lean T_steer"
    *pose, pitch, steer, rear_angle, front_angle, lean_torque, steer_torque = functions_of_time(names)
    w, c, tilt, rear_radius, front_radius = (p[name] for name in ("w", "c", "lam", "rR", "rF"))
    leaned = hub(pose, -rear_radius, time_derivative(rear_angle))
    carrier = leaned * rotate("Y", pitch)
    column = carrier * translate(w + c, 0, rear_radius) * rotate("Y", tilt)
    steered = column * rotate("Z", steer)
    carried = steered * rotate("Y", -tilt)
    axle = carried * translate(-c, 0, -front_radius)
    rear = Body(leaned * rotate("Y", rear_angle), *_wheel(p, "R"), name="rear wheel")
    frame = _body(carrier * translate(p["xB"], 0, p["zB"] + rear_radius), p, "B", "frame")
    fork = _body(carried * translate(p["xH"] - w - c, 0, p["zH"]), p, "H", "fork")
    front = Body(axle * rotate("Y", front_angle), *_wheel(p, "F"), name="front wheel")
    loads = [
        Torque(leaned, lean_torque, 0, 0, on=frame, name="lean torque"),
        Torque(column, 0, 0, steer_torque, on=fork, reaction=frame, name="steering torque"),
    ]
    slip = project(_velocity_at_contact(front, axle, front_radius), steered).components
    held = [Constraint(each, f"slip {axis}") for each, axis in zip(slip, "xyz", strict=True)]
    return System(
        [rear, frame, fork, front],
        loads,
        [pitch, steer, rear_angle, front_angle],
        held,
        Vector(ground, 0, 0, p["g"]),
        speeds=HUB_SPEEDS,
        inputs=[lean_torque, steer_torque],
        name="Bicycle",
    )


def _wheel(p: Mapping[str, Expr], part: str) -> tuple[Expr, ...]:
    """Return the mass and the moments of inertia of a wheel about y."""
    across = p[f"I{part}xx"]
    return p[f"m{part}"], across, p[f"I{part}yy"], across


def _body(frame: Frame, p: Mapping[str, Expr], part: str, name: str) -> Body:
    Ixx, Iyy, Izz, Ixz = (p[f"I{part}{axes}"] for axes in ("xx", "yy", "zz", "xz"))
    return Body(frame, p[f"m{part}"], Ixx, Iyy, Izz, Cxz=-Ixz, name=name)


def _velocity_at_contact(wheel: Body, axle: Frame, radius: Expr) -> Vector:
    """Return the velocity of the material point of a wheel below its centre, in the plane of the wheel."""
    forward, _, down = project(Vector(ground, 0, 0, 1), axle).components
    length = sqrt(forward**2 + down**2)
    to_ground = Vector(axle, radius * forward / length, 0, radius * down / length)
    return velocity(wheel.center_of_mass) + cross(angular_velocity(wheel.frame), to_ground)
