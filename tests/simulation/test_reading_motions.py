"""Accelerations and multipliers along a motion: found once, and what they are."""

from __future__ import annotations

import numpy as np
import pytest

from symbody import Motion, simulate, time_derivative
from tests.reference.mechanisms.andrews import andrews
from tests.reference.mechanisms.n_fourbar import n_fourbar

PROBLEM = andrews()


def moved(**options: object) -> Motion:
    instants = np.linspace(0, 0.003, 301)
    return simulate(PROBLEM.equations, PROBLEM.parameters, PROBLEM.initial, instants, **options)


def test_accelerations_and_multipliers_compile_once(compiled_functions):
    motion = moved()
    compiled_functions.clear()
    for acceleration in motion.model.accelerations:
        motion[acceleration]
        motion[2 * acceleration + motion.model.speeds[0]]
    assert compiled_functions == []
    for multiplier in motion.model.multipliers:
        motion[multiplier]
        motion[multiplier * motion.model.accelerations[0]]
    assert len(compiled_functions) == 1


def test_accelerations_are_the_rates_of_the_speeds():
    motion = moved(rtol=1e-11, atol=1e-12)
    speeds, step = motion.states[:, 7:], motion.t[1] - motion.t[0]
    slopes = (speeds[:-4] - 8 * speeds[1:-3] + 8 * speeds[3:-1] - speeds[4:]) / (12 * step)
    read = np.transpose([motion[u] for u in motion.model.accelerations])
    np.testing.assert_allclose(read[2:-2], slopes, rtol=1e-4, atol=1e-5 * np.abs(read).max())


@pytest.mark.parametrize("options", [{}, {"constraints": (100.0, 1.0)}, {"method": "bdf"}])
def test_accelerations_and_multipliers_satisfy_the_equations_of_motion(options):
    motion, equations = moved(**options), PROBLEM.equations
    terms = motion.evaluate([*equations.residuals])
    scale = np.abs(motion.evaluate([*equations.forcing])).max()
    assert np.abs(terms).max() < 1e-9 * max(scale, 1.0)
    together = motion.evaluate([*motion.model.accelerations, *motion.model.multipliers])
    assert np.array_equal(together, np.vstack([motion.accelerations.T, motion.multipliers.T]))


def test_the_rate_of_an_expression_holds_accelerations():
    problem = n_fourbar(2)
    motion = simulate(problem.equations, problem.parameters, problem.initial, np.linspace(0, 0.2, 101))
    first = problem.equations.coordinates[0]
    second = time_derivative(first**2, 2)
    expected = 2 * motion[first] * motion[time_derivative(first, 2)] + 2 * motion[time_derivative(first)] ** 2
    np.testing.assert_allclose(motion[second], expected, rtol=1e-12)
    assert motion.multipliers.shape == (101, len(problem.equations.multipliers))
