"""The heavy top: its place after 0.2 s, its period and its integrals, by three descriptions of one body.

Brüls, Cardona & Arnold, Lie group generalized-alpha time integration of constrained flexible multibody systems, 2012.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from numpy.testing import assert_allclose

from symbody import Motion, simulate
from tests.reference.mechanisms.heavy_top import heavy_top, heavy_top_held_in_a_point, heavy_top_on_quaternion
from tests.reference.mechanisms.problem import Problem, reference

NUMBERS = reference("heavy_top")
START, END = NUMBERS["rows"]
ACCURACY = 10 * NUMBERS["accuracy_estimate"]
DESCRIPTIONS = [heavy_top, heavy_top_on_quaternion, heavy_top_held_in_a_point]
description = pytest.mark.parametrize("description", DESCRIPTIONS)


def moved(description: Callable[[], Problem], t: list[float], rtol: float = 1e-12) -> Motion:
    problem = description()
    return simulate(
        problem.equations,
        problem.parameters,
        problem.initial,
        t,
        rtol=rtol,
        atol=rtol,
        outputs=problem.named,
    )


def row(motion: Motion, instant: int) -> dict[str, np.ndarray]:
    """Return the reference's quantities at an instant of the motion."""
    names = {"quaternion_wxyz": "e0 e1 e2 e3", "omega_body": "w1 w2 w3", "x_com": "x y z"}
    return {
        key: np.array([motion.outputs[name][instant] for name in text.split()]) for key, text in names.items()
    }


@description
def test_start_and_end(description: Callable[[], Problem]) -> None:
    motion = moved(description, [START["t"], (START["t"] + END["t"]) / 2, END["t"]])
    for instant, expected in ((0, START), (-1, END)):
        for key, value in row(motion, instant).items():
            assert_allclose(value, expected[key], rtol=0, atol=ACCURACY, err_msg=key)
        assert_allclose(motion.outputs["z"][instant], expected["z_com_elliptic"], rtol=0, atol=ACCURACY)
        assert_allclose(motion.energy[instant], expected["E"], rtol=1e-12)


@description
def test_the_height_repeats_after_the_nutation_period(description: Callable[[], Problem]) -> None:
    period = NUMBERS["nutation_period"]
    instants = [0, 0.1, 0.2, period, period + 0.1, period + 0.2]
    z = moved(description, instants, rtol=1e-11).outputs["z"]  # beyond, rounding grows with the steps
    assert_allclose(z[3:], z[:3], rtol=0, atol=1e-9)


@description
def test_energy_spin_and_constraints_are_kept(description: Callable[[], Problem]) -> None:
    motion = moved(description, list(np.linspace(0, 10, 101)), 1e-10)
    assert motion.energy_drift < 1e-9
    assert motion.constraint_drift < 1e-10
    assert motion.constraint_rate_drift < 1e-10
    # The top is symmetric and its weight has no moment about its axis.
    assert_allclose(motion.outputs["w2"], NUMBERS["parameters"]["omega0_body"][1], rtol=1e-9)
    norm = sum(motion.outputs[name] ** 2 for name in ("e0", "e1", "e2", "e3"))
    assert_allclose(norm, 1, rtol=0, atol=1e-10)
