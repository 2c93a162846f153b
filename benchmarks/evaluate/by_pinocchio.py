"""Pinocchio [Carpentier et al. 2019]: its algorithms in C++, and the model that CasADi's code is made of."""

from __future__ import annotations

import ctypes
from functools import cache
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import numpy as np

from .contender import Contender
from .native import FOLDER, available, compiled, pointer
from .robot import GRAVITY, Robot
from .states import States, Values

_DEFINITIONS = (
    "BOOST_MPL_LIMIT_LIST_SIZE=30", "BOOST_MPL_LIMIT_VECTOR_SIZE=30", "BOOST_MPL_CFG_NO_PREPROCESSED_HEADERS",
    "BOOST_FUSION_INVOKE_MAX_ARITY=12",
)  # fmt: skip
"""What Pinocchio's own build defines."""

_ALGORITHMS = {
    "inverse dynamics": (0, "rnea"), "mass matrix": (1, "crba"), "forward dynamics": (2, "aba"),
}  # fmt: skip


def missing() -> str:
    """Return what the machine lacks, or nothing."""
    if find_spec("pinocchio") is None:
        return "Pinocchio (pip: pin)"
    if not (_prefix() / "include" / "eigen3").is_dir():
        return "Eigen's headers (pip: cmeel-eigen)"
    return "" if available("g++") else "g++"


def _prefix() -> Path:
    """Return the folder of the wheels' headers and libraries."""
    spec = find_spec("pinocchio")
    assert spec is not None
    assert spec.origin is not None
    return next(p for p in Path(spec.origin).resolve().parents if (p / "include" / "pinocchio").is_dir())


def model(robot: Robot) -> Any:
    """Return Pinocchio's model of a robot; links on fixed joints belong to the joint before."""
    import pinocchio as pin  # noqa: PLC0415 - a rival

    made = pin.Model()
    made.gravity.linear = np.array(GRAVITY)
    root = made.addJoint(0, pin.JointModelFreeFlyer(), pin.SE3.Identity(), "base") if robot.floats else 0
    placed = {robot.root: (root, pin.SE3.Identity())}
    for joint in robot.joints:
        number, before = placed[joint["parent"]]
        placement = before * pin.SE3(np.array(joint["R"], float), np.array(joint["xyz"], float))
        if joint["name"] in robot.order:
            number = made.addJoint(number, _joint(pin, joint["axis"]), placement, joint["name"])
            placement = pin.SE3.Identity()
        placed[joint["child"]] = number, placement
    for link in robot.links:
        number, placement = placed[link["name"]]
        inertia = pin.Inertia(link["mass"], np.array(link["com"]), np.array(link["inertia_com"]))
        if number > 0:
            made.appendBodyToJoint(number, inertia, placement)
    return made


def _joint(pin: Any, axis: list[float]) -> Any:
    plain = {
        (1.0, 0.0, 0.0): pin.JointModelRX,
        (0.0, 1.0, 0.0): pin.JointModelRY,
        (0.0, 0.0, 1.0): pin.JointModelRZ,
    }
    kind = plain.get(tuple(map(float, axis)))
    return kind() if kind else pin.JointModelRevoluteUnaligned(np.array(axis, float))


def configuration(robot: Robot, states: States) -> Values:
    """Return the positions with the quaternion's scalar last, and the order of the model's joints."""
    q = states.position.copy()
    if robot.floats:
        q[:, 3:7] = q[:, [4, 5, 6, 3]]
    return np.ascontiguousarray(q)


def in_order(robot: Robot, made: Any) -> None:
    """Raise an error unless the model has the joints in the robot's order."""
    names = tuple(made.names)[1 + robot.floats :]
    if names != robot.order:
        raise RuntimeError(f"{robot.name}: joints in another order, {names}")


def contender(robot: Robot, states: States, function: str) -> Contender:
    """Return an algorithm of Pinocchio's in C++."""
    made = model(robot)
    in_order(robot, made)
    numbers, (kind, algorithm) = _numbers(made), _ALGORITHMS[function]
    n, count = made.nv, len(states.speed)
    q, v = configuration(robot, states), np.ascontiguousarray(states.speed)
    a = np.ascontiguousarray(states.force if kind == 2 else states.acceleration)
    out = np.empty((count, n * n if kind == 1 else n))

    def time(repetitions: int) -> float:
        arrays = map(pointer, (q, v, a, out))
        return float(_loop()(kind, pointer(numbers), len(numbers), *arrays, count, repetitions))

    def outputs() -> Values:
        if kind != 1:
            return out
        upper = np.triu_indices(n)
        return out.reshape(count, n, n).transpose(0, 2, 1)[:, upper[0], upper[1]]

    return Contender(f"Pinocchio, {algorithm} in C++", time, outputs)


@cache
def _loop() -> Any:
    prefix = _prefix()
    options = [f"-D{definition}" for definition in _DEFINITIONS]
    options += [f"-I{prefix}/include", f"-I{prefix}/include/eigen3", "-std=c++17", f"-L{prefix}/lib"]
    options += ["-lpinocchio_default", f"-Wl,-rpath,{prefix}/lib"]
    function = compiled(FOLDER / "pinocchio_loop.cpp", *options, compiler="g++").pinocchio_loop
    function.restype = ctypes.c_double
    return function


def _numbers(made: Any) -> Values:
    """Return the rows that the loop in C++ builds the same model of."""
    kinds = {"JointModelFreeFlyer": 0, "JointModelRX": 1, "JointModelRY": 2, "JointModelRZ": 3}
    rows = []
    for number in range(1, made.njoints):
        joint, placement, inertia = made.joints[number], made.jointPlacements[number], made.inertias[number]
        kind = kinds.get(joint.shortname(), 4)
        axis = joint.extract().axis if kind == 4 else np.zeros(3)
        parts = (
            [kind, made.parents[number]], placement.rotation.ravel(), placement.translation, axis,
            [inertia.mass], inertia.lever, inertia.inertia.ravel(),
        )  # fmt: skip
        rows.append(np.concatenate([np.asarray(part, float) for part in parts]))
    return np.ascontiguousarray(rows)
