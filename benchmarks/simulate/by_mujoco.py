"""MuJoCo: the same arm as a model of its own, integrated by its threaded `rollout` with its method of order 4."""

from __future__ import annotations

import importlib.util
from collections.abc import Callable
from typing import Any

import numpy as np

from ..evaluate.robot import Robot
from .problem import Array

Many = Callable[[Array, float], Array]

AT_ONCE = 250
"""The motions of a call: it returns the states of all steps."""


def missing() -> str:
    """Return what to install, nothing if all is there."""
    return "" if importlib.util.find_spec("mujoco") else "MuJoCo (pip: mujoco)"


def by_rollout(robot: Robot, duration: float, threads: int) -> Many:
    """Return `mujoco.rollout` of all motions, with a number of threads; the setting is the number of steps."""
    import mujoco  # noqa: PLC0415 - it is looked for first
    from mujoco import rollout  # noqa: PLC0415

    text = description(robot)

    def many(starts: Array, steps: float) -> Array:
        model = mujoco.MjModel.from_xml_string(text)
        model.opt.timestep = duration / steps
        data = [mujoco.MjData(model) for _ in range(threads)]
        whole = np.hstack([np.zeros((len(starts), 1)), starts])  # the time comes first
        parts = [
            rollout.rollout(model, data, part, nstep=int(steps))[0][:, -1, 1 : 1 + starts.shape[1]]
            for part in np.array_split(whole, -(-len(whole) // AT_ONCE))
        ]
        return np.concatenate(parts)

    return many


def description(robot: Robot) -> str:
    """Return the arm in MuJoCo's format, with numbers of all digits."""
    links = {link["name"]: link for link in robot.links}

    def body(joint: dict[str, Any]) -> str:
        link = links[joint["child"]]
        inside = [
            f'<joint type="hinge" axis="{_row(joint["axis"])}"/>' if joint["name"] in robot.order else "",
            _inertial(link),
            *(body(other) for other in robot.joints if other["parent"] == link["name"]),
        ]
        place = f'pos="{_row(joint["xyz"])}" quat="{_row(_quaternion(np.array(joint["R"])))}"'
        return f"<body {place}>{''.join(inside)}</body>"

    bodies = "".join(body(joint) for joint in robot.joints if joint["parent"] == robot.root)
    return (
        '<mujoco><compiler angle="radian" balanceinertia="false" boundmass="0"/>'
        '<option integrator="RK4" gravity="0 0 -9.81">'
        '<flag constraint="disable" contact="disable" energy="disable"/></option>'
        f"<worldbody>{bodies}</worldbody></mujoco>"
    )


def _inertial(link: dict[str, Any]) -> str:
    if not link["mass"]:
        return ""
    (xx, xy, xz), (_, yy, yz), (_, _, zz) = link["inertia_com"]
    return (
        f'<inertial pos="{_row(link["com"])}" mass="{link["mass"]!r}" '
        f'fullinertia="{_row([xx, yy, zz, xy, xz, yz])}"/>'
    )


def _quaternion(R: Array) -> list[float]:
    """Return the quaternion of a rotation, scalar first."""
    from scipy.spatial.transform import Rotation  # noqa: PLC0415

    x, y, z, w = Rotation.from_matrix(R).as_quat()
    return [float(w), float(x), float(y), float(z)]


def _row(numbers: Any) -> str:
    return " ".join(repr(float(x)) for x in numbers)
