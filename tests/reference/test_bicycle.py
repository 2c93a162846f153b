"""The bicycle: the full nonlinear model, whose wheels roll by constraints on velocities, against the benchmark.

Meijaard, Papadopoulos, Ruina & Schwab, Linearized dynamics equations for the balance and steer of a bicycle, 2007:
``M q'' + v C1 q' + (g K0 + v^2 K2) q = f`` with the lean and the steering angle, 14 digits, and the eigenvalues.
Basu-Mandal, Chatterjee & Papadopoulos, Hands-free circular motions of a benchmark bicycle, 2007: accelerations of the
nonlinear model, 13 decimals.
"""

from __future__ import annotations

from functools import cache
from math import pi
from typing import NamedTuple

import numpy as np
import pytest
from numpy.testing import assert_allclose
from numpy.typing import NDArray

from symbody import (
    Expr,
    consistent_state,
    diff,
    embedded,
    gradient,
    ground,
    origin,
    simulate,
    substitute,
    symbols,
    time_derivative,
)
from tests.reference.mechanisms.bicycle import bicycle
from tests.reference.mechanisms.problem import reference

NUMBERS = reference("bicycle")
NONLINEAR = NUMBERS["nonlinear"]
BICYCLE = bicycle()
PARAMETERS = {BICYCLE.parameters[name]: value for name, value in NUMBERS["parameters"].items()}
NO_TORQUES = dict.fromkeys(BICYCLE.torques, 0)
q = BICYCLE.coordinates
v, g = symbols("v"), BICYCLE.parameters["g"]

Entries = list[list[Expr]]


class LinearModel(NamedTuple):
    """The equations of lean and steering angle near straight running with the speed v, ``M q'' + C q' + K q = f``."""

    M: Entries
    C: Entries
    K: Entries
    others: Entries
    """The slopes by the place, the yaw, the pitch and the acceleration of the rear wheel."""


@cache
def linear_model() -> LinearModel:
    """Return the derivatives of the equations in three independent speeds, without multipliers, at straight running."""
    rates = {name: time_derivative(angle) for name, angle in q.items()}
    eqs = embedded(BICYCLE.equations, [rates[name] for name in ("lean", "steer", "rear_angle")])
    angles = [q["lean"], q["steer"]]
    straight = [
        dict.fromkeys(eqs.accelerations, 0),
        {rates["lean"]: 0, rates["steer"]: 0, rates["rear_angle"]: -v / BICYCLE.parameters["rR"]},
        dict.fromkeys([q[name] for name in ("lean", "pitch", "steer")], 0) | NO_TORQUES,
    ]

    def slopes(unknowns: list[Expr]) -> Entries:
        rows = [gradient(residual, unknowns) for residual in eqs.residuals[:2]]
        for values in straight:
            rows = [substitute(row, values) for row in rows]
        return [[*row] for row in rows]

    accelerations = [time_derivative(angle, 2) for angle in angles]
    return LinearModel(
        slopes(accelerations),
        slopes([rates["lean"], rates["steer"]]),
        slopes(angles),
        slopes([q["x"], q["y"], q["yaw"], q["pitch"], time_derivative(q["rear_angle"], 2)]),
    )


def numbers(entries: Entries, **values: float) -> NDArray[np.float64]:
    known = PARAMETERS | {symbols(name): value for name, value in values.items()}
    return np.array([[entry.evaluate(known) for entry in row] for row in entries])


def test_mass_matrix() -> None:
    assert_allclose(numbers(linear_model().M), NUMBERS["M"], rtol=1e-13)


def test_damping_is_linear_in_the_speed() -> None:
    C = linear_model().C
    C1 = [[diff(entry, v) for entry in row] for row in C]
    for row, slopes in zip(C, C1, strict=True):
        assert row == [v * slope for slope in slopes]
    assert_allclose(numbers(C1), NUMBERS["C1"], rtol=1e-12, atol=1e-13)


def test_stiffness_is_of_weight_and_of_the_square_of_the_speed() -> None:
    K = linear_model().K
    K0 = [[diff(entry, g) for entry in row] for row in K]
    K2 = [[diff(entry, v, 2) / 2 for entry in row] for row in K]
    rows = zip(K, K0, K2, strict=True)
    for entry, weight, running in (entries for row in rows for entries in zip(*row, strict=True)):
        assert entry == g * weight + v**2 * running
    assert_allclose(numbers(K0), NUMBERS["K0"], rtol=1e-13)
    assert_allclose(numbers(K2), NUMBERS["K2"], rtol=1e-13, atol=1e-13)


def test_nothing_else_acts_on_lean_and_steering() -> None:
    """To first order, the pitch at which the front wheel touches the ground doesn't depend on lean and steering."""
    assert all(slope.is_zero for row in linear_model().others for slope in row)
    touching = BICYCLE.equations.system.position_constraints[0]
    rest = dict.fromkeys([q[name] for name in ("lean", "pitch", "steer")], 0)
    lean, pitch, steer = substitute(gradient(touching, [q["lean"], q["pitch"], q["steer"]]), rest)
    assert [lean.is_zero, pitch.is_zero, steer.is_zero] == [True, False, True]


@pytest.mark.parametrize("row", NUMBERS["eigenvalues"], ids=lambda row: f"{row['v']}-m/s")
def test_eigenvalues(row: dict[str, list[list[float]]]) -> None:
    expected = [complex(*each) for each in row["published"]]
    assert_allclose(np.sort_complex(eigenvalues(row["v"])), np.sort_complex(expected), rtol=1e-13, atol=1e-12)


def eigenvalues(speed: float) -> NDArray[np.complex128]:
    M, C, K, _ = (numbers(matrix, v=speed) for matrix in linear_model())
    state = np.block([[np.zeros((2, 2)), np.eye(2)], [-np.linalg.solve(M, K), -np.linalg.solve(M, C)]])
    return np.linalg.eigvals(state)


def test_speeds_between_which_it_is_stable() -> None:
    weave, capsize = NUMBERS["speeds"]["weave"], NUMBERS["speeds"]["capsize"]
    swinging = max(eigenvalues(weave), key=lambda each: each.imag)
    assert_allclose([swinging.real, swinging.imag], [0, NUMBERS["speeds"]["weave_frequency"]], atol=1e-12)
    assert np.abs(eigenvalues(capsize)).min() < 1e-12
    for speed, is_stable in ((weave - 0.01, False), (weave + 0.01, True), (capsize + 0.01, False)):
        assert (eigenvalues(speed).real.max() < 0) == is_stable


def initial(
    speed: float, lean: float, steer: float, lean_rate: float, steer_rate: float
) -> dict[Expr, float]:
    """Return a state on the constraints near straight running."""
    given = dict.fromkeys((q["x"], q["y"], q["yaw"], q["rear_angle"], q["front_angle"]), 0.0)
    given |= {q["lean"]: lean, q["steer"]: steer}
    rates = {"lean": lean_rate, "steer": steer_rate, "rear_angle": -speed / NUMBERS["parameters"]["rR"]}
    given |= {time_derivative(q[name]): rate for name, rate in rates.items()}
    return consistent_state(BICYCLE.equations, PARAMETERS, given, inputs=NO_TORQUES)


def test_mass_matrix_of_given_torques() -> None:
    columns = []
    for torques in ((1, 0), (0, 1)):
        inputs = dict(zip(BICYCLE.torques, torques, strict=True))
        start = initial(5.0, 0, 0, 0, 0)
        motion = simulate(BICYCLE.equations, PARAMETERS, start, t=(0, 1e-6), inputs=inputs)
        columns.append([motion[time_derivative(q[name], 2)][0] for name in ("lean", "steer")])
    assert_allclose(np.array(columns).T @ NUMBERS["M"], np.eye(2), atol=1e-12)


def angles_of(values: dict[str, float], offset: float) -> dict[str, float]:
    """Return angles, or their rates if the offset is zero, from those of Basu-Mandal et al.

    The wheels turn there in the frames that carry them; here the rear one turns in a frame that doesn't pitch.
    """
    pitch = offset - values["phi"]
    return {
        "yaw": -values["theta"],
        "lean": offset / 2 - values["psi"],
        "pitch": pitch,
        "steer": -values["psif"],
        "rear_angle": pitch - values["betar"],
        "front_angle": -values["betaf"],
    }


def test_nonlinear_accelerations() -> None:
    angles, rates = angles_of(NONLINEAR["state"], pi), angles_of(NONLINEAR["rates"], 0)
    given = {q[name]: value for name, value in angles.items() if name != "pitch"} | {q["x"]: 0, q["y"]: 0}
    given |= {time_derivative(q[name]): rates[name] for name in ("lean", "steer", "rear_angle")}
    start = consistent_state(BICYCLE.equations, PARAMETERS, given, inputs=NO_TORQUES)
    motion = simulate(BICYCLE.equations, PARAMETERS, start, t=(0, 1e-6), inputs=NO_TORQUES)
    for name, angle in angles.items():
        assert_allclose(
            [motion[q[name]][0], motion[time_derivative(q[name])][0]], [angle, rates[name]], atol=1e-12
        )
    expected = angles_of(NONLINEAR["accelerations"], 0)
    found = {name: motion[time_derivative(q[name], 2)][0] for name in expected}
    assert_allclose([*found.values()], [*expected.values()], rtol=1e-12, atol=1e-12)
    centre = origin(BICYCLE.equations.system.bodies[0].frame).projected(ground).coordinates
    for level, values in enumerate(("rates", "accelerations"), start=1):
        x, y, z = (motion[time_derivative(each, level)][0] for each in centre)
        assert_allclose([-x, y, -z], [NONLINEAR[values][name] for name in "xyz"], rtol=1e-12, atol=1e-12)


def test_motion_keeps_constraints_and_energy() -> None:
    motion = simulate(
        BICYCLE.equations,
        PARAMETERS,
        initial(4.6, 0.0, 0.0, 0.5, 0.0),
        t=(0, 5),
        inputs=NO_TORQUES,
        rtol=1e-10,
        atol=1e-10,
    )
    assert motion.constraint_drift < 1e-9
    assert motion.energy_drift < 1e-9
    assert np.abs(motion[q["lean"]]).max() < 0.3  # self-stable between 4.29 and 6.02 m/s
