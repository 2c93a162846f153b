"""The motion of a planar double pendulum by angles and by natural coordinates, with its tensions."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from numpy.testing import assert_allclose

from symbody import Motion, simulate
from tests.reference.mechanisms.double_pendulum import double_pendulum, natural_double_pendulum
from tests.reference.mechanisms.problem import Problem, reference

NUMBERS = reference("double_pendulum_natural")
INSTANTS = [row["t"] for row in NUMBERS["rows"]]
# Of two integrations that the file was made by, the largest difference.
ACCURACY = 10 * NUMBERS["dev"]
description = pytest.mark.parametrize("description", [double_pendulum, natural_double_pendulum])


def moved(description: Callable[[], Problem], t: list[float] | None = None, rtol: float = 1e-13) -> Motion:
    problem = description()
    return simulate(
        problem.equations,
        problem.parameters,
        problem.initial,
        INSTANTS if t is None else t,
        rtol=rtol,
        atol=rtol,
        outputs=problem.named,
    )


def rows(key: str) -> np.ndarray:
    return np.array([row[key] for row in NUMBERS["rows"]])


def assert_close(values: np.ndarray, key: str) -> None:
    """Assert that values agree with the reference's, relative to the largest of the kind."""
    assert_allclose(values, rows(key), rtol=0, atol=ACCURACY * np.abs(rows(key)).max(), err_msg=key)


@description
def test_places_speeds_and_energy(description: Callable[[], Problem]) -> None:
    motion = moved(description)
    places = ("x1", "y1", "x2", "y2")
    assert_close(np.array([motion.outputs[name] for name in places]).T, "xy")
    assert_close(np.array([motion.outputs[f"v_{name}"] for name in places]).T, "v")
    assert_close(motion.energy, "E")


def test_angles() -> None:
    states = moved(double_pendulum).states
    assert_close(states[:, :2], "theta")
    assert_close(states[:, 2:], "thetad")


def test_accelerations_multipliers_and_tensions() -> None:
    motion = moved(natural_double_pendulum)
    assert_close(motion.accelerations, "a")
    assert_close(motion.multipliers, "lam")
    lengths = [NUMBERS["parameters"][name] for name in ("l1", "l2")]
    for k, length in enumerate(lengths):
        assert_close(-2 * length * motion.multipliers[:, k], f"tension{k + 1}")


@description
def test_energy_and_rods_are_kept(description: Callable[[], Problem]) -> None:
    motion = moved(description, list(np.linspace(0, 10, 101)), 1e-10)
    assert motion.energy_drift < 1e-9
    assert motion.constraint_drift < 1e-10
    assert motion.constraint_rate_drift < 1e-10
