"""IFToMM benchmark A02: four-bar linkages through positions where all bars lie along one line, by their exact motion.

There the constraints depend on each other, and each parallelogram could go on as an antiparallelogram.
"""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest
from numpy.testing import assert_allclose

from symbody import Event, Motion, System, kinetic_energy, simulate
from tests.reference.mechanisms.n_fourbar import n_fourbar
from tests.reference.mechanisms.problem import reference

RESULTS = reference("n_fourbar")["results"]["N=2"]
ROWS = np.array(RESULTS["rows"])


@cache
def moved(rtol: float, method: str = "auto", N: int = 2) -> Motion:
    problem = n_fourbar(N)
    return simulate(
        problem.equations,
        problem.parameters,
        problem.initial,
        ROWS[:, 0],
        method=method,
        rtol=rtol,
        atol=rtol,
        outputs=problem.named,
        events=[Event(problem.named["xB0"], direction=1)],
    )


def of_first_tip(motion: Motion) -> np.ndarray:
    return np.array([motion.outputs[name] for name in ("xB0", "yB0", "vxB0", "vyB0")]).T


# What tolerances of one step become in ten seconds, five turns through two singular positions each.
ERRORS = [("auto", 1e-7, 1e-3), ("auto", 1e-8, 2e-5), ("auto", 1e-9, 5e-6), ("tsit5", 1e-8, 2e-5)]


@pytest.mark.parametrize(("method", "rtol", "error"), ERRORS)
def test_it_passes_the_singular_positions(method: str, rtol: float, error: float) -> None:
    motion = moved(rtol, method)
    assert_allclose(of_first_tip(motion), ROWS[:, 1:], rtol=0, atol=error)
    assert motion.statistics.steps < 1000


def test_period() -> None:
    """The first tip rises over its foot, to the right, once a turn."""
    passages = [event.t for event in moved(1e-9).events if event.t > 0.1]
    turns = np.arange(1, len(passages) + 1)
    assert len(passages) == 5
    assert_allclose(passages, turns * RESULTS["period_full_turn"], rtol=0, atol=1e-6)


def test_kinetic_energy_at_the_first_instant_and_along_the_motion() -> None:
    motion = moved(1e-9)
    assert isinstance(motion.system, System)
    kinetic = motion[kinetic_energy(motion.system)]
    _, y, vx, vy = of_first_tip(motion).T
    g = reference("n_fourbar")["parameters"]["g"]
    gained = RESULTS["first_moment"] * g * (1 - y)
    assert_allclose(kinetic[0], RESULTS["kinetic_energy0"], rtol=1e-14)
    # Near a singular position round-off of 1e-16 in the places is one of 1e-11 in the speeds of the other cranks.
    assert_allclose(kinetic, RESULTS["effective_inertia"] * (vx**2 + vy**2) / 2, rtol=1e-9)
    assert_allclose(kinetic, RESULTS["kinetic_energy0"] + gained, rtol=0, atol=1e-8 * kinetic.max())


@pytest.mark.parametrize("N", [1, 2, 3, 5])
def test_each_loop_stays_a_parallelogram(N: int) -> None:
    motion = moved(1e-8, N=N)
    angles = motion.states[:, : 2 * N + 1]
    assert_allclose(np.sin(angles[:, 1 : N + 1] - angles[:, :1]), 0, atol=1e-9)
    assert_allclose(np.sin(angles[:, N + 1 :]), 0, atol=1e-9)
    assert motion.constraint_drift < 1e-10
    assert motion.constraint_rate_drift < 1e-10


def test_energy_is_kept_at_a_tight_tolerance() -> None:
    """Where steps end is chance, and near a singular position round-off grows: of many runs the median counts."""
    motions = [moved(rtol) for rtol in np.linspace(0.9e-10, 1.1e-10, 9)]
    assert np.median([motion.energy_drift for motion in motions]) < 1e-9
    errors = [np.abs(of_first_tip(motion) - ROWS[:, 1:]).max() for motion in motions]
    assert np.median(errors) < 5e-7
    # A step that ends 1e-3 rad before a singular position may still lead onto another branch.
    assert np.sum(np.array(errors) > 1e-5) <= 1
    assert max(motion.constraint_drift for motion in motions) < 1e-10


@pytest.mark.parametrize("N", [1, 2, 3])
def test_energy_is_kept_at_the_instants_between_steps(N: int) -> None:
    """Where a long step passes a singular position, the rates beside the constraints say nothing of the motion."""
    problem = n_fourbar(N)
    drifts = [
        simulate(problem.equations, problem.parameters, problem.initial, t=(0, 10), rtol=rtol).energy_drift
        for rtol in np.linspace(0.9e-10, 1.1e-10, 15)
    ]
    assert np.median(drifts) < 7e-10
    assert np.sum(np.array(drifts) > 1e-9) <= 4
