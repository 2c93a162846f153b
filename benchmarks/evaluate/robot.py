"""Robots as plain data, from which every contender builds its model: joints, and a body on each."""

from __future__ import annotations

import json
import random
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from symbody import (
    Body,
    Expr,
    Force,
    Frame,
    Point,
    System,
    Torque,
    Vector,
    floating_frame,
    functions_of_time,
    ground,
    origin,
    rotate,
    translate,
)
from symbody.multibody import Load

ROBOTS = Path(__file__).resolve().parents[2] / "tests" / "reference" / "robots"
GRAVITY = (0.0, 0.0, -9.81)


@dataclass(frozen=True)
class Robot:
    """A tree of links.

    Attributes:
        name: what the report calls it.
        joints: name, parent and child link, placement ``R`` and ``xyz``, axis in the child's frame; fixed ones too.
        links: name, mass, centre of mass, inertia about it.
        order: the moving joints, in the order of the coordinates.
        root: the first link.
        floats: whether it floats, by a quaternion and velocities in its own axes.
    """

    name: str
    joints: tuple[dict[str, Any], ...]
    links: tuple[dict[str, Any], ...]
    order: tuple[str, ...]
    root: str
    floats: bool = False

    @property
    def size(self) -> int:
        """The number of equations of motion."""
        return len(self.order) + 6 * self.floats


def from_reference(file: str, name: str) -> Robot:
    """Return a robot of the reference results."""
    data = json.loads((ROBOTS / f"{file}.json").read_text(encoding="utf-8"))
    joints, links = tuple(data["joints"]), tuple(data["links"])
    return Robot(
        name, joints, links, tuple(data["joint_order"]), data["root_link"], data.get("floating_base", False)
    )


def chain(n: int) -> Robot:
    """Return n general bodies on joints about x, y, z in turn: the numbers are arbitrary, but always the same."""
    draw = random.Random(n)

    def vector() -> list[float]:
        return [round(draw.uniform(-0.5, 0.5), 3) for _ in range(3)]

    joints, links = [], [_link("link0", 0.0, [0.0] * 3, np.zeros((3, 3)))]
    for i in range(1, n + 1):
        axis = [float(k == (i - 1) % 3) for k in range(3)]
        joints.append(
            {
                "name": f"q{i}", "parent": f"link{i - 1}", "child": f"link{i}",
                "R": np.eye(3).tolist(), "xyz": vector(), "axis": axis,
            }
        )  # fmt: skip
        half = np.round(np.array([vector() for _ in range(3)]), 3)
        links.append(_link(f"link{i}", round(draw.uniform(0.5, 2.0), 3), vector(), half @ half.T + np.eye(3)))
    order = tuple(joint["name"] for joint in joints)
    return Robot(f"chain of {n} general bodies", tuple(joints), tuple(links), order, "link0")


def _link(name: str, mass: float, com: list[float], inertia: Any) -> dict[str, Any]:
    return {"name": name, "mass": mass, "com": com, "inertia_com": np.round(inertia, 6).tolist()}


def system(robot: Robot, *, driven: bool = False) -> System:
    """Return the robot as a system of symbody, its numbers folded in; driven by forces along the speeds, if wanted."""
    coordinates = {name: functions_of_time(name) for name in robot.order}
    frames = {robot.root: floating_frame("base") if robot.floats else ground}
    for joint in robot.joints:
        pose = np.eye(4)
        pose[:3, :3] = joint["R"]
        frame = frames[joint["parent"]] * translate(*joint["xyz"]) * Frame(pose.tolist())
        if joint["name"] in coordinates:
            frame *= rotate(tuple(joint["axis"]), coordinates[joint["name"]])
        frames[joint["child"]] = frame
    bodies = {
        link["name"]: _body(link, frames[link["name"]])
        for link in robot.links
        if frames[link["name"]] != ground
    }
    loads = _drives(robot, frames, bodies) if driven else []
    gravity = Vector(ground, *GRAVITY)
    return System(list(bodies.values()), loads, coordinates=list(coordinates.values()), gravity=gravity)


def forces(robot: Robot) -> tuple[Expr, ...]:
    """Return the forces along the speeds, as functions of time."""
    base = ("base_Fx", "base_Fy", "base_Fz", "base_Mx", "base_My", "base_Mz") if robot.floats else ()
    return tuple(functions_of_time(f"force_{name}") for name in (*base, *robot.order))


def _drives(robot: Robot, frames: dict[str, Frame], bodies: dict[str, Body]) -> list[Load]:
    """Return a motor on every joint, and a force and a torque on a floating base."""
    named, loads = dict(zip(robot.order, forces(robot)[6 * robot.floats :], strict=True)), list[Load]()
    for joint in (joint for joint in robot.joints if joint["name"] in named):
        moment = [named[joint["name"]] * component for component in joint["axis"]]
        child, parent = bodies[joint["child"]], bodies.get(joint["parent"])
        loads.append(Torque(frames[joint["child"]], *moment, on=child, reaction=parent))
    if robot.floats:
        base, body = frames[robot.root], bodies[robot.root]
        loads.append(Force(base, *forces(robot)[:3], at=origin(base), on=body))
        loads.append(Torque(base, *forces(robot)[3:6], on=body))
    return loads


def _body(link: dict[str, Any], frame: Frame) -> Body:
    (Ix, Ixy, Ixz), (_, Iy, Iyz), (_, _, Iz) = link["inertia_com"]
    return Body(Point(frame, *link["com"]), link["mass"], Ix, Iy, Iz, -Iyz, -Ixz, -Ixy)
