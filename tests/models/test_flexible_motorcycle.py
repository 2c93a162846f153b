"""The flexible motorcycle, which has no published eigenvalues, against its poses by the points of the MathWorks port.

The port lists where bodies and joints are in straight running. Rotations about these points give the place of each
body, differences its velocities, and these the mass matrix and the gradient of the potential energy.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.testing import assert_allclose
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from symbody import models, newton_euler
from tests.reference.mechanisms.problem import reference

Array = NDArray[np.float64]
Pose = Callable[[Array], tuple[Array, Array]]

_TABLE = reference("motorcycles")["sharp1994"]
PORT: dict[str, float] = {
    name: value
    for part in ("masses", "inertias", "geometry", "stiffness_damping")
    for name, value in _TABLE[part].items()
}
H = 1e-5


def turned(axis: Array, angle: float, about: Array) -> tuple[Array, Array]:
    """Return R and d of the map ``R r + d`` that turns about an axis through a point."""
    R = Rotation.from_rotvec(axis * angle).as_matrix()
    return R, about - R @ about


def machine() -> list[tuple[float, Array, Pose]]:
    """Return mass, tensor and pose of the bodies; the products of the port count with z downwards."""
    p, (x, y, z) = PORT, np.eye(3)
    ce, se = np.cos(p["epsilon"]), np.sin(p["epsilon"])
    c1, s1 = np.cos(p["epsilon1"]), np.sin(p["epsilon1"])
    kk = p["ll"] + (p["ee"] + p["trail"] - p["jj"] * se) / ce
    points = {
        1: (0, p["hh"]),
        2: (-p["bb_b"], p["hh_b"]),
        3: (kk, p["jj"]),
        4: (-p["bb_p"], p["hh_s"] + p["hh_p"]),
        5: (-p["bb"], p["Rr"]),
        6: (p["ll"], p["Rf"]),
        7: (p["aa"] * c1 - p["bb"], p["aa"] * s1),
        8: (p["ll"] + p["trail"] / ce - p["ss"] * se / ce, p["ss"]),
        9: (-p["bb_p"], p["hh_s"]),
    }
    at = {k: np.array([ahead, 0, up]) for k, (ahead, up) in points.items()}
    steering, across, arm_axis = ce * z - se * x, ce * x + se * z, c1 * z - s1 * x
    tilted = np.column_stack([across, y, steering])

    def frame(q: Array) -> tuple[Array, Array]:
        return Rotation.from_euler("ZXY", q[3:6]).as_matrix(), q[:3]

    def arm(q: Array) -> tuple[Array, Array]:
        return turned(arm_axis, q[6], at[7])

    def fork(q: Array) -> tuple[Array, Array]:
        head, place = turned(across, q[7], at[8])
        steer, aside = turned(steering, q[9], at[8])
        return head @ steer, head @ (aside + q[8] * y) + place

    def rider(q: Array) -> tuple[Array, Array]:
        return turned(x, q[10], at[9])

    def still(_: Array) -> tuple[Array, Array]:
        return np.eye(3), np.zeros(3)

    def pose(
        part: Callable[[Array], tuple[Array, Array]], point: Array, axes: Array, spin: int | None = None
    ) -> Pose:
        def placed(q: Array) -> tuple[Array, Array]:
            (R0, d0), (R, d) = frame(q), part(q)
            own = axes if spin is None else axes @ Rotation.from_rotvec(y * q[spin]).as_matrix()
            return R0 @ R @ own, R0 @ (R @ point + d) + d0

        return placed

    def tensor(Ixx: float, Iyy: float, Izz: float, product: float = 0) -> Array:
        return np.array([[Ixx, 0, product], [0, Iyy, 0], [product, 0, Izz]])

    pitch = {name: value for name, value in numbers().items() if name in ("Iry", "Ify", "Ipy")}
    E = np.eye(3)
    return [
        (p["Mr"], tensor(p["Irx"], pitch["Iry"], p["Irz"], p["Irxz"]), pose(still, at[1], E)),
        (p["Mb"], tensor(p["irwx"], 0, 0), pose(arm, at[2], E)),
        (p["Mf"], tensor(p["Ifx"], pitch["Ify"], p["Ifz_hands_on"]), pose(fork, at[3], tilted)),
        (p["Mp"], tensor(p["Ipx"], pitch["Ipy"], p["Ipz"], p["Ipxz"]), pose(rider, at[4], E)),
        (0, tensor(0, p["irwy"], 0), pose(arm, at[5], E, 11)),
        (0, tensor(0, p["iry"], 0), pose(still, at[1], E, 11)),
        (0, tensor(0, p["ifwy"], 0), pose(fork, at[6], E, 12)),
    ]


def numbers() -> dict[str, float]:
    return {str(symbol): value for symbol, value in models.flexible_motorcycle().parameters.items()}


def mass_matrix(q: Array) -> Array:
    """Return the sum of ``m v_i . v_j + w_i . I w_j`` by differences of the poses."""
    found = np.zeros((len(q), len(q)))
    for mass, inertia, pose in machine():
        R, _ = pose(q)
        moved = [(pose(q + step), pose(q - step)) for step in H * np.eye(len(q))]
        v = np.array([(there[1] - back[1]) / (2 * H) for there, back in moved])
        W = [R.T @ (there[0] - back[0]) / (2 * H) for there, back in moved]
        w = np.array([[each[2, 1], each[0, 2], each[1, 0]] for each in W])
        found += mass * v @ v.T + w @ inertia @ w.T
    return found


def potential(q: Array) -> float:
    """Return the energy of the weights and of the springs."""
    springs = zip(("lambda", "gamma", "v", "steer_on", "zeta"), q[[6, 7, 8, 9, 10]], strict=True)
    weights = sum(9.81 * mass * pose(q)[1][2] for mass, _, pose in machine())
    return float(weights + sum(PORT[f"k_{name}"] * angle**2 / 2 for name, angle in springs))


def test_mass_matrix_and_weights_are_those_of_the_points_of_the_port() -> None:
    model = models.flexible_motorcycle()
    eqs = newton_euler(model.system)
    q = np.array([0.3, -0.2, 0.01, 0.4, 0.3, -0.05, 0.02, -0.03, 0.004, 0.2, 0.1, 0.7, -0.4])
    overturning = (model["Cr5"], model["Cf5"])
    at_rest = (*model.inputs, *model.system.states, *eqs.speeds, *eqs.multipliers, *overturning)
    known: dict[Any, float] = {**model.parameters, **dict.fromkeys(at_rest, 0.0)}
    known |= dict(zip(eqs.coordinates, q, strict=True))
    n = len(q)
    found = np.array([[eqs.mass_matrix[i, j].evaluate(known) for j in range(n)] for i in range(n)])
    assert_allclose(found, mass_matrix(q), rtol=1e-7, atol=1e-7)
    steps = H * np.eye(n)
    gradient = [(potential(q + step) - potential(q - step)) / (2 * H) for step in steps]
    assert_allclose([each.evaluate(known) for each in eqs.bias], gradient, rtol=1e-6, atol=1e-5)
