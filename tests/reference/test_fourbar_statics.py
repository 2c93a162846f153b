"""The hanging four-bar linkage that is pulled aside: its equilibrium, and the small and large motions about it."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose

from symbody import Equilibrium, Event, equilibrium, simulate, time_derivative
from tests.reference.mechanisms.fourbar_statics import fourbar_statics
from tests.reference.mechanisms.problem import reference

NUMBERS = reference("fourbar_statics")
STATIC = NUMBERS["static"]
PROBLEM = fourbar_statics()
EQUATIONS = PROBLEM.equations


@pytest.fixture(scope="module")
def rest() -> Equilibrium:
    return equilibrium(EQUATIONS, PROBLEM.parameters, guess=PROBLEM.initial)


def test_angles_and_multipliers_of_the_equilibrium(rest: Equilibrium) -> None:
    q = [rest.coordinates[name] for name in EQUATIONS.coordinates]
    assert_allclose(q, STATIC["q_rad"], rtol=1e-12)
    assert_allclose(np.degrees(q), STATIC["q_deg"], rtol=1e-12)
    # in the reference grad V = G^T lambda, and so here: forcing + phi_q^T lambda = 0 with forcing = -grad V
    assert_allclose(list(rest.multipliers.values()), STATIC["multipliers"], rtol=1e-12)


def test_it_stays_there(rest: Equilibrium) -> None:
    motion = simulate(EQUATIONS, PROBLEM.parameters, rest.coordinates, (0, 10))
    assert_allclose(motion.states[:, :3], np.tile(STATIC["q_rad"], (len(motion), 1)), atol=1e-8)
    assert_allclose(motion.multipliers, np.tile(STATIC["multipliers"], (len(motion), 1)), rtol=1e-7)


def frequency() -> float:
    """Return the frequency of small swings by the reference's geometry, angles and multipliers.

    ``t (V'' - lambda . phi'') t = omega^2 t M t`` where t is the one direction that the loop leaves, phi_q t = 0.
    """
    LA, LB, LC, mA, mB, mC, g, H = (
        NUMBERS["parameters"][name] for name in ("LA", "LB", "LC", "mA", "mB", "mC", "g", "H")
    )
    q, (force_x, force_y) = np.array(STATIC["q_rad"]), STATIC["multipliers"]
    c, s, lengths = np.cos(q), np.sin(q), np.array([LA, LB, -LC])
    hanging = np.array([(mA / 2 + mB) * LA, mB * LB / 2, mC * LC / 2])
    stiffness = g * hanging * c + H * np.array([0, 0, LC]) * s + lengths * (force_x * c + force_y * s)
    M = np.diag([(mA / 3 + mB) * LA**2, mB * LB**2 / 3, mC * LC**2 / 3])
    M[0, 1] = M[1, 0] = mB * LA * LB / 2 * np.cos(q[0] - q[1])
    way = np.cross(-lengths * s, lengths * c)
    return float(np.sqrt(way @ (stiffness * way) / (way @ M @ way)))


def test_the_frequency_of_small_swings(rest: Equilibrium) -> None:
    assert rest.is_stable
    assert_allclose(rest.eigenvalues, [-1j * frequency(), 1j * frequency()], rtol=1e-10)


def test_it_swings_about_it_with_that_frequency(rest: Equilibrium) -> None:
    """The period grows with the square of the swing, here by 4e-8 of it."""
    qA = EQUATIONS.coordinates[0]
    start = {qA: STATIC["q_rad"][0] + 1e-3}
    motion = simulate(
        EQUATIONS,
        PROBLEM.parameters,
        start,
        (0, 10),
        guess=rest.coordinates,
        events=[Event(time_derivative(qA), direction=-1)],
        rtol=1e-10,
    )
    tops = [event.t for event in motion.events if event.t > 1]
    assert len(tops) == 4
    assert_allclose(np.diff(tops), 2 * np.pi / frequency(), rtol=1e-7)


def test_energy_and_constraints_where_it_swings_far() -> None:
    motion = simulate(
        EQUATIONS,
        PROBLEM.parameters,
        {EQUATIONS.coordinates[0]: 1.2},
        (0, 10),
        guess=PROBLEM.initial,
        rtol=1e-10,
    )
    assert np.ptp(motion[EQUATIONS.coordinates[0]]) > 1
    assert motion.energy_drift < 1e-9
    assert motion.constraint_drift < 1e-10
    assert motion.constraint_rate_drift < 1e-10
