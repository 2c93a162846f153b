"""Build a robot of ``robots/`` with the public names: a chain of frames, a body for every link."""

from __future__ import annotations

import json
from collections import deque
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

from symbody import (
    Body,
    Expr,
    Frame,
    Point,
    System,
    Vector,
    floating_frame,
    functions_of_time,
    ground,
    rotate,
    translate,
)

FIXED = ("double_pendulum", "furuta", "gimbal_gyro", "ur5_6dof", "panda_7dof")
FLOATING = ("solo12_floating",)
NAMES = (*FIXED, *FLOATING)
FOLDER = Path(__file__).parent / "robots"


@dataclass(frozen=True)
class Robot:
    """A robot's model beside the states at which others have computed its dynamics."""

    system: System
    gravity: Vector
    moving_bodies: tuple[Body, ...]
    states: tuple[dict[str, Any], ...]


@cache
def robot(name: str) -> Robot:
    """Return the robot described in ``robots/<name>.json``, its base at rest or afloat."""
    return robot_on(floating_frame("base") if name in FLOATING else ground, (), name)


def robot_on(base: Frame, coordinates: Sequence[Expr], name: str) -> Robot:
    """Return a robot on a frame that moves by the given coordinates; links on fixed joints are bodies too."""
    description = json.loads((FOLDER / f"{name}.json").read_text(encoding="utf-8"))
    joints = {joint: functions_of_time(joint) for joint in description["joint_order"]}
    frames = {description["root_link"]: base}
    waiting = deque(description["joints"])
    while waiting:
        joint = waiting.popleft()
        if joint["parent"] in frames:
            frames[joint["child"]] = frames[joint["parent"]] * _joint_frame(joint, joints.get(joint["name"]))
        else:
            waiting.append(joint)
    bodies = {link["name"]: _link_body(link, frames[link["name"]]) for link in description["links"]}
    gravity = Vector(ground, *description["conventions"]["gravity"])
    moving = tuple(
        body for link, body in bodies.items() if base != ground or link != description["root_link"]
    )
    system = System(list(bodies.values()), coordinates=[*coordinates, *joints.values()], gravity=gravity)
    return Robot(system, gravity, moving, tuple(description["states"]))


def motion_at(state: Mapping[str, Any]) -> tuple[list[float], list[float], list[float]]:
    """Return coordinates, speeds and accelerations in the order of the references: the base's, if it floats, first."""
    q, u, a = ([value for key in keys for value in state.get(key, ())] for keys in _MOTION)
    return q, u, a


_MOTION = (
    ("base_position_world", "base_quaternion_wxyz", "joint_q"),
    ("base_linear_velocity_body", "base_angular_velocity_body", "joint_v"),
    ("base_spatial_acceleration_body_linear", "base_angular_acceleration_body", "joint_a"),
)


def _joint_frame(joint: dict[str, Any], coordinate: Expr | None) -> Frame:
    pose = np.eye(4)
    pose[:3, :3] = joint["R"]
    placed = translate(*joint["xyz"]) * Frame(pose.tolist())
    return placed if coordinate is None else placed * rotate(tuple(joint["axis"]), coordinate)


def _link_body(link: dict[str, Any], frame: Frame) -> Body:
    (Ix, Ixy, Ixz), (_, Iy, Iyz), (_, _, Iz) = link["inertia_com"]
    return Body(Point(frame, *link["com"]), link["mass"], Ix, Iy, Iz, -Iyz, -Ixz, -Ixy)
