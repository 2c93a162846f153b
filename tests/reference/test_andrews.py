"""Andrews' squeezing mechanism: its start, its motion, accelerations and multipliers, by the Test Set for IVP Solvers.

The Test Set's numbers at the end come from an integration of the equations of index 3 at a tolerance of 1e-14. They
satisfy the equations of motion, but accelerations and multipliers are 1e-6 off those that belong to their positions and
speeds: of such equations these are the least accurate. Those at the beginning are known to 28 digits.
"""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose

from symbody import Motion, consistent_state, simulate
from tests.reference.mechanisms.andrews import andrews
from tests.reference.mechanisms.problem import reference

NUMBERS = reference("andrews")
TOLERANCES = NUMBERS["tolerance_suggested"]
INSTANTS = np.linspace(0, 0.03, 31)
PROBLEM = andrews()

# Test Set for IVP Solvers (CWI, Bari), andrews.f: what lies beside the coordinates in `init` and `solut`.
ACCELERATIONS_AT_START = [14222.4439199541138705911625887, -10666.8329399655854029433719415, 0, 0, 0, 0, 0]
MULTIPLIERS_AT_START = [98.5668703962410896057654982170, -6.12268834425566265503114393122, 0, 0, 0, 0]
SPEEDS = [
    *(0.1139920302151208e4, -0.1424379294994111e4, 0.1103291221937134e2, 0.1929337464421385e2),
    *(0.5735699284790808e0, -0.1929337464421385e2, 0.3231791658026955e0),
]
ACCELERATIONS = [
    *(-0.2463176316945196e5, 0.5185037701610329e5, 0.3241025686413781e6, 0.5667493645176213e6),
    *(0.1674362929479361e5, -0.5667493645176222e6, 0.9826520791458422e4),
]
MULTIPLIERS = [
    *(0.1991753333731910e3, -0.2975531228015052e2, 0.2306654119098399e2),
    *(0.3145271365475927e2, 0.2264249232082739e2, 0.1161740700019673e2),
]


def moved(method: str = "auto", rtol: float = 1e-12, atol: float = 1e-13) -> Motion:
    return simulate(
        PROBLEM.equations,
        PROBLEM.parameters,
        PROBLEM.initial,
        INSTANTS,
        method=method,
        rtol=rtol,
        atol=atol,
    )


@pytest.fixture(scope="module")
def motion() -> Motion:
    return moved()


def test_it_begins_where_the_loops_close() -> None:
    """One angle decides: the others are found from guesses of one digit."""
    q = PROBLEM.equations.coordinates
    known = dict(zip(q, NUMBERS["initial_q"], strict=True))
    guess = {name: round(value, 1) for name, value in known.items()}
    Theta = q[1]
    del guess[Theta]
    state = consistent_state(PROBLEM.equations, PROBLEM.parameters, {Theta: known[Theta]}, guess=guess)
    assert_allclose([state[name] for name in q], NUMBERS["initial_q"], rtol=0, atol=1e-14)
    assert_allclose([state[name] for name in PROBLEM.equations.speeds], NUMBERS["initial_qd"], atol=0)


def test_accelerations_and_multipliers_at_the_start(motion: Motion) -> None:
    assert_allclose(motion.accelerations[0], ACCELERATIONS_AT_START, rtol=1e-12, atol=1e-9)
    assert_allclose(-motion.multipliers[0], MULTIPLIERS_AT_START, rtol=1e-12, atol=1e-12)


@pytest.mark.parametrize(("method", "rtol"), [("auto", 1e-12), ("tsit5", 1e-11), ("bdf", 1e-11)])
def test_it_arrives_where_the_test_set_says(method: str, rtol: float) -> None:
    q = moved(method, rtol).states[-1, :7]
    assert_allclose(q, NUMBERS["published_solution_t003"], rtol=0, atol=TOLERANCES["q"])


def test_speeds_accelerations_and_multipliers_at_the_end(motion: Motion) -> None:
    assert_allclose(motion.states[-1, 7:], SPEEDS, rtol=TOLERANCES["qd"])
    assert_allclose(motion.accelerations[-1], ACCELERATIONS, rtol=TOLERANCES["qdd"])
    assert_allclose(-motion.multipliers[-1], MULTIPLIERS, rtol=1e-5)


def test_ida_agrees(motion: Motion) -> None:
    pytest.importorskip("sksundae")
    other = moved("ida", 1e-12, 1e-12)
    scale = np.abs(motion.states).max(axis=0)
    assert_allclose(other.states / scale, motion.states / scale, atol=1e-8)
    scale = np.abs(motion.multipliers).max(axis=0)
    assert_allclose(other.multipliers / scale, motion.multipliers / scale, atol=1e-7)


def test_the_loops_stay_closed() -> None:
    motion = moved(rtol=1e-6, atol=1e-6)
    assert motion.constraint_drift < 1e-10
    assert motion.constraint_rate_drift < 1e-10


def test_the_work_of_motor_and_spring_becomes_energy() -> None:
    motion = moved(rtol=1e-10, atol=1e-10)
    beta, _, gamma, *_ = motion.states.T
    xb, yb, xc, yc, sc, sd, c0, l0, torque = (
        NUMBERS["parameters"][name] for name in ("xb", "yb", "xc", "yc", "sc", "sd", "c0", "l0", "mom")
    )
    dx = xb + sc * np.sin(gamma) + sd * np.cos(gamma) - xc
    dy = yb - sc * np.cos(gamma) + sd * np.sin(gamma) - yc
    potential = c0 * (np.hypot(dx, dy) - l0) ** 2 / 2 - torque * beta
    assert_allclose(motion.work, potential[0] - potential, rtol=0, atol=1e-10)
    assert motion.energy_drift < 1e-9
