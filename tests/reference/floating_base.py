"""A floating base by position and angles: from Pinocchio's speeds, in axes of the base, to coordinates and rates.

Pinocchio's v holds the velocity of the base's origin and its angular velocity in axes of the base, and a its time
derivative, componentwise; here the base has a position and the angles yaw, pitch and roll. With v = J(q) q',

    M_q = J^T M J,    f_q = J^T f,    q'' = J^-1 (a - J' q').
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from symbody import functions_of_time, rotate, translate
from tests.reference.robot import Robot, robot_on

Values = NDArray[np.float64]


@dataclass(frozen=True)
class FloatingState:
    """A state in the coordinates x, y, z, yaw, pitch, roll and the joints', and the dynamics there."""

    q: Values
    u: Values
    a: Values
    mass_matrix: Values
    forcing: Values
    inverse_dynamics: Values
    kinetic_energy: float
    potential_energy: float


def robot_on_angles(name: str) -> Robot:
    """Return a robot whose base moves by x, y, z, yaw, pitch and roll."""
    x, y, z, yaw, pitch, roll = base = functions_of_time("x y z yaw pitch roll")
    frame = translate(x, y, z) * rotate("Z", yaw) * rotate("Y", pitch) * rotate("X", roll)
    return robot_on(frame, base, name)


def floating_state(state: Mapping[str, Any]) -> FloatingState:
    """Translate a state of ``robots/solo12_floating.json``."""
    rotation = _rotation(np.array(state["base_quaternion_wxyz"]))
    angles = _yaw_pitch_roll(rotation)
    jacobian = _jacobian(rotation, angles)
    v = np.array(
        [*state["base_linear_velocity_body"], *state["base_angular_velocity_body"], *state["joint_v"]], float
    )
    a = np.array(
        [
            *state["base_spatial_acceleration_body_linear"],
            *state["base_angular_acceleration_body"],
            *state["joint_a"],
        ],
        float,
    )
    u = np.linalg.solve(jacobian, v)
    drift = _jacobian_rate(rotation, angles, v, u) @ u
    M, bias = np.array(state["mass_matrix"]), np.array(state["bias"])
    return FloatingState(
        np.array([*state["base_position_world"], *angles, *state["joint_q"]]),
        u,
        np.linalg.solve(jacobian, a - drift),
        jacobian.T @ M @ jacobian,
        -jacobian.T @ (bias + M @ drift),
        jacobian.T @ np.array(state["inverse_dynamics"]),
        state["kinetic_energy"],
        state["potential_energy"],
    )


def _rotation(quaternion: Values) -> Values:
    w, x, y, z = quaternion / np.linalg.norm(quaternion)
    skew = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + 2 * w * skew + 2 * skew @ skew


def _yaw_pitch_roll(R: Values) -> tuple[float, float, float]:
    pitch = np.arctan2(-R[2, 0], np.hypot(R[0, 0], R[1, 0]))
    return float(np.arctan2(R[1, 0], R[0, 0])), float(pitch), float(np.arctan2(R[2, 1], R[2, 2]))


def _jacobian(rotation: Values, angles: tuple[float, float, float]) -> Values:
    """J: the position's rates turned into the base's axes, and the angular velocity of the angles' rates."""
    J = np.eye(18)
    J[:3, :3] = rotation.T
    _, pitch, roll = angles
    J[3:6, 3:6] = [
        [-np.sin(pitch), 0, 1],
        [np.cos(pitch) * np.sin(roll), np.cos(roll), 0],
        [np.cos(pitch) * np.cos(roll), -np.sin(roll), 0],
    ]
    return J


def _jacobian_rate(rotation: Values, angles: tuple[float, float, float], v: Values, u: Values) -> Values:
    """J': of the first block by (R^T)' = -w x R^T, of the second by the chain rule."""
    J = np.zeros((18, 18))
    wx, wy, wz = v[3:6]
    J[:3, :3] = -np.array([[0, -wz, wy], [wz, 0, -wx], [-wy, wx, 0]]) @ rotation.T
    (_, pitch, roll), (_, pitch_rate, roll_rate) = angles, u[3:6]
    sp, cp, sr, cr = np.sin(pitch), np.cos(pitch), np.sin(roll), np.cos(roll)
    J[3:6, 3:6] = [
        [-cp * pitch_rate, 0, 0],
        [-sp * sr * pitch_rate + cp * cr * roll_rate, -sr * roll_rate, 0],
        [-sp * cr * pitch_rate - cp * sr * roll_rate, -cr * roll_rate, 0],
    ]
    return J
