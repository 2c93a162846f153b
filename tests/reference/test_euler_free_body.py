"""A body that nothing turns, against Jacobi's elliptic functions [Landau & Lifshitz, Mechanics, par. 37]."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.special import ellipk

from symbody import Event, Motion, simulate
from tests.reference.mechanisms.euler_free_body import RUNS, euler_free_body
from tests.reference.mechanisms.problem import reference

MOMENTS = np.array(reference("euler_free_body")["principal_moments"])
SPINS = ("w1", "w2", "w3")
run = pytest.mark.parametrize("run", RUNS)


def moved(run: str, t: list[float], rtol: float = 1e-13) -> Motion:
    problem = euler_free_body(run)
    spin = problem.named["w2"]
    return simulate(
        problem.equations,
        problem.parameters,
        problem.initial,
        t,
        rtol=rtol,
        atol=rtol,
        outputs=problem.named,
        events=[Event(spin, direction=1)],
    )


def of(motion: Motion, names: tuple[str, ...]) -> np.ndarray:
    return np.array([motion.outputs[name] for name in names]).T


@run
def test_angular_velocity(run: str) -> None:
    rows = np.array(RUNS[run]["rows"])
    motion = moved(run, rows[:, 0])
    assert_allclose(of(motion, SPINS), rows[:, 1:], rtol=0, atol=1e-11)


@run
def test_period_by_events_and_after_half_of_it(run: str) -> None:
    numbers = RUNS[run]
    half = numbers["flip_half_period"]
    motion = moved(run, [0, half, 2 * half, 4 * half])
    first, second = (event.t for event in motion.events)
    assert_allclose(second - first, numbers["period"], rtol=0, atol=1e-11)
    assert_allclose(4 * ellipk(numbers["modulus_m"]) / numbers["rate_n"], second - first, rtol=0, atol=1e-11)
    start, flipped, again, later = of(motion, SPINS)
    assert_allclose(flipped, start * (-1, -1, 1), rtol=0, atol=1e-11)
    assert_allclose([again, later], [start, start], rtol=0, atol=1e-11)


@run
def test_integrals_and_attitude(run: str) -> None:
    """The momentum stays in the axes of ground, though the body's axes turn: the attitude is right."""
    motion = moved(run, list(np.linspace(0, 10, 101)), 1e-10)
    spins, momenta = of(motion, SPINS), of(motion, ("L1", "L2", "L3"))
    assert_allclose((MOMENTS * spins**2).sum(axis=1), RUNS[run]["two_T"], rtol=1e-9)
    assert_allclose((momenta**2).sum(axis=1), RUNS[run]["L2"], rtol=1e-9)
    assert_allclose(momenta, np.broadcast_to(MOMENTS * RUNS[run]["omega0"], momenta.shape), atol=1e-8)
    assert motion.energy_drift < 1e-9
