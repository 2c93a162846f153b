"""Build a robot of ``robots/`` with the public names: a chain of frames, a body for every link."""

from __future__ import annotations

import json
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

from symbody import Body, Expr, Frame, Point, System, Vector, functions_of_time, ground, rotate, translate

NAMES = ("double_pendulum", "furuta", "gimbal_gyro", "panda_7dof")
FOLDER = Path(__file__).parent / "robots"


@dataclass(frozen=True)
class Robot:
    """A robot's model beside the states at which others have computed its dynamics."""

    system: System
    gravity: Vector
    moving_bodies: tuple[Body, ...]
    coordinates: tuple[Expr, ...]
    states: tuple[dict[str, Any], ...]


@cache
def robot(name: str) -> Robot:
    """Return the robot described in ``robots/<name>.json``; links on fixed joints are bodies too."""
    description = json.loads((FOLDER / f"{name}.json").read_text(encoding="utf-8"))
    coordinates = {joint: functions_of_time(joint) for joint in description["joint_order"]}
    base = _base_coordinates() if description["floating_base"] else {}
    frames: dict[str, Frame] = {description["root_link"]: _base_frame(base) if base else ground}
    for joint in description["joints"]:
        frames[joint["child"]] = frames[joint["parent"]] * _joint_frame(joint, coordinates.get(joint["name"]))
    bodies = {link["name"]: _link_body(link, frames[link["name"]]) for link in description["links"]}
    gravity = Vector(ground, *description["conventions"]["gravity"])
    moving = tuple(body for link, body in bodies.items() if base or link != description["root_link"])
    coordinates = base | coordinates
    system = System(bodies=list(bodies.values()), coordinates=list(coordinates.values()), gravity=gravity)
    return Robot(system, gravity, moving, tuple(coordinates.values()), tuple(description["states"]))


def _base_coordinates() -> dict[str, Expr]:
    return {name: functions_of_time(name) for name in ("x", "y", "z", "yaw", "pitch", "roll")}


def _base_frame(base: dict[str, Expr]) -> Frame:
    x, y, z, yaw, pitch, roll = base.values()
    return translate(x, y, z) * rotate("Z", yaw) * rotate("Y", pitch) * rotate("X", roll)


def _joint_frame(joint: dict[str, Any], coordinate: Expr | None) -> Frame:
    pose = np.eye(4)
    pose[:3, :3] = joint["R"]
    placed = translate(*joint["xyz"]) * Frame(pose.tolist())
    return placed if coordinate is None else placed * rotate(tuple(joint["axis"]), coordinate)


def _link_body(link: dict[str, Any], frame: Frame) -> Body:
    (Ix, Ixy, Ixz), (_, Iy, Iyz), (_, _, Iz) = link["inertia_com"]
    return Body(Point(frame, *link["com"]), link["mass"], Ix, Iy, Iz, -Iyz, -Ixz, -Ixy)
