"""IFToMM benchmark A01: the motion of a point mass on a massless rod, by angle and by natural coordinates."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from numpy.testing import assert_allclose

from symbody import Event, Motion, simulate
from tests.reference.mechanisms.problem import Problem, reference
from tests.reference.mechanisms.simple_pendulum import natural_simple_pendulum, simple_pendulum

NUMBERS = reference("simple_pendulum")
ROWS = np.array(NUMBERS["rows"])
description = pytest.mark.parametrize("description", [simple_pendulum, natural_simple_pendulum])


def moved(description: Callable[[], Problem], rtol: float) -> Motion:
    problem = description()
    return simulate(
        problem.equations,
        problem.parameters,
        problem.initial,
        ROWS[:, 0],
        rtol=rtol,
        atol=rtol,
        outputs=problem.named,
        events=[Event(problem.named["x"], direction=1)],
    )


@description
def test_motion_is_the_exact_one(description: Callable[[], Problem]) -> None:
    motion = moved(description, 1e-13)
    values = np.array([motion.outputs[name] for name in ("x", "y", "theta_dot")]).T
    # The errors of some 300 steps of 1e-13 each add up.
    assert_allclose(values, ROWS[:, 1:], rtol=0, atol=1e-11)


@description
def test_period(description: Callable[[], Problem]) -> None:
    """From one passage of the lowest position to the right to the next."""
    passages = [event.t for event in moved(description, 1e-13).events]
    assert_allclose(np.diff(passages), NUMBERS["period"], rtol=0, atol=1e-11)
    assert_allclose(passages[0], NUMBERS["period"] / 4, rtol=0, atol=1e-11)


@description
def test_energy_and_rod_are_kept(description: Callable[[], Problem]) -> None:
    motion = moved(description, 1e-10)
    assert_allclose(motion.energy[0], 0, atol=1e-14)
    assert motion.energy_drift < 1e-9
    assert motion.constraint_drift < 1e-10
    assert motion.constraint_rate_drift < 1e-10
