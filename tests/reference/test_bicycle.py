"""The bicycle: the full nonlinear model, whose wheels roll by constraints on velocities, against the benchmark.

Meijaard, Papadopoulos, Ruina & Schwab, Linearized dynamics equations for the balance and steer of a bicycle, 2007:
``M q'' + v C1 q' + (g K0 + v^2 K2) q = f`` with the lean and the steering angle, 14 digits.
"""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose

from symbody import consistent_state, simulate, time_derivative
from tests.reference.mechanisms.bicycle import bicycle
from tests.reference.mechanisms.problem import reference

NUMBERS = reference("bicycle")
M, C1, K0, K2 = (np.array(NUMBERS[name]) for name in ("M", "C1", "K0", "K2"))
BICYCLE = bicycle()
PARAMETERS = {BICYCLE.parameters[name]: value for name, value in NUMBERS["parameters"].items()}
STEP = 1e-4


def initial(speed: float, lean: float, steer: float, lean_rate: float, steer_rate: float) -> dict:
    """Return a state on the constraints near straight running."""
    q = BICYCLE.coordinates
    given = dict.fromkeys((q["x"], q["y"], q["yaw"], q["rear_angle"], q["front_angle"]), 0.0)
    given |= {q["lean"]: lean, q["steer"]: steer}
    rates = {"lean": lean_rate, "steer": steer_rate, "rear_angle": -speed / NUMBERS["parameters"]["rR"]}
    given |= {time_derivative(q[name]): rate for name, rate in rates.items()}
    return consistent_state(BICYCLE.equations, PARAMETERS, given, inputs=dict.fromkeys(BICYCLE.torques, 0))


def accelerations(
    speed: float, state: tuple[float, ...] = (0, 0, 0, 0), torques: tuple[float, float] = (0, 0)
) -> np.ndarray:
    """Return those of lean and steering angle."""
    inputs = dict(zip(BICYCLE.torques, torques, strict=True))
    motion = simulate(BICYCLE.equations, PARAMETERS, initial(speed, *state), t=(0, 1e-6), inputs=inputs)
    rates = [time_derivative(BICYCLE.coordinates[name]) for name in ("lean", "steer")]
    return motion.accelerations[0, [motion.model.speeds.index(rate) for rate in rates]]


@pytest.mark.parametrize("speed", [2.0, 5.0, 8.0])
def test_linear_coefficients(speed: float) -> None:
    steps = STEP * np.eye(4)
    slopes = np.array(
        [(accelerations(speed, tuple(d)) - accelerations(speed, tuple(-d))) / (2 * STEP) for d in steps]
    ).T
    g = NUMBERS["parameters"]["g"]
    expected = np.linalg.solve(-M, np.hstack([g * K0 + speed**2 * K2, speed * C1]))
    assert_allclose(slopes, expected, rtol=0, atol=1e-7 * np.abs(expected).max())


def test_mass_matrix_of_given_torques() -> None:
    columns = np.array([accelerations(5.0, torques=torques) for torques in ((1, 0), (0, 1))]).T
    assert_allclose(columns @ M, np.eye(2), atol=1e-12)


def test_motion_keeps_constraints_and_energy() -> None:
    motion = simulate(
        BICYCLE.equations,
        PARAMETERS,
        initial(4.6, 0.0, 0.0, 0.5, 0.0),
        t=(0, 5),
        inputs=dict.fromkeys(BICYCLE.torques, 0),
        rtol=1e-10,
        atol=1e-10,
    )
    assert motion.constraint_drift < 1e-9
    assert motion.energy_drift < 1e-9
    assert np.abs(motion[BICYCLE.coordinates["lean"]]).max() < 0.3  # self-stable between 4.29 and 6.02 m/s
