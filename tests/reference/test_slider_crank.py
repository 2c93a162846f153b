"""The slider-crank of SUNDIALS' example idaSlCrank: its equations, its motion, constraints and energy."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose
from numpy.typing import NDArray

from symbody import consistent_state, lambdify, simulate, symbols
from tests.reference.mechanisms.problem import reference
from tests.reference.mechanisms.slider_crank import slider_crank

NUMBERS = reference("slider_crank")
ROWS = np.array(NUMBERS["published_rows"])
PROBLEM = slider_crank()
EQUATIONS = PROBLEM.equations
UNDAMPED = PROBLEM.parameters | {symbols("c"): 0.0}

Array = NDArray[np.float64]


def length(q: NDArray[np.complex128]) -> NDArray[np.complex128]:
    """Return the spring's length by the reference's formula."""
    a, (q, x, p) = NUMBERS["parameters"]["a"], q
    return np.sqrt(x**2 - x * (np.cos(p) + a * np.cos(q)) + (1 + a**2) / 4 + a * np.cos(p - q) / 2)


def generalised_force(q: Array, u: Array) -> Array:
    """Return ``-(k (l - l0) + c l') dl/dq + (0, F, -F sin p)``, the derivatives of l by complex steps."""
    k, c, l0, F = (NUMBERS["parameters"][name] for name in ("k", "c", "l0", "F"))
    slope = np.array([length(q + 1e-30j * e).imag / 1e-30 for e in np.eye(3)])
    pull = k * (length(q).real - l0) + c * slope @ u
    force: Array = -pull * slope + np.array([0, F, -F * np.sin(q[2])])
    return force


def test_bodies_and_loads_have_the_references_equations() -> None:
    """The reference writes energy, force and constraints of the coordinates; the model has bodies, joints, loads."""
    f = lambdify(
        [list(EQUATIONS.coordinates), list(EQUATIONS.speeds), list(PROBLEM.parameters)],
        [EQUATIONS.mass_matrix, list(EQUATIONS.forcing), list(EQUATIONS.constraints)],
    )
    a, J1, m2, J2 = (NUMBERS["parameters"][name] for name in ("a", "J1", "m2", "J2"))
    rng = np.random.default_rng(4)
    for _ in range(20):
        q, u = rng.uniform(-1.5, 1.5, (2, 3))
        mass_matrix, forcing, constraints = f(q, u, list(PROBLEM.parameters.values()))
        crank, x, p = q
        known = [x - np.cos(p) - a * np.cos(crank), -np.sin(p) - a * np.sin(crank)]
        assert_allclose(mass_matrix, np.diag([J1, m2, J2]), atol=1e-15)
        assert_allclose(forcing, generalised_force(q, u), rtol=1e-12, atol=1e-13)
        assert_allclose(constraints, known, atol=1e-15)


def test_it_begins_where_the_loop_closes() -> None:
    q, x, p = EQUATIONS.coordinates
    state = consistent_state(EQUATIONS, PROBLEM.parameters, {q: np.pi / 2}, guess={x: 1.0, p: -0.5})
    a = NUMBERS["parameters"]["a"]
    expected = [np.pi / 2, np.cos(np.arcsin(-a)), np.arcsin(-a), 0, 0, 0]
    assert_allclose(list(state.values()), expected, rtol=0, atol=1e-14)


@pytest.mark.parametrize("method", ["auto", "bdf", "ida"])
def test_it_moves_as_published(method: str) -> None:
    """Within half a unit of the last of five digits, and ten times the published run's own tolerance, 1e-6."""
    if method == "ida":
        pytest.importorskip("sksundae")
    motion = simulate(
        EQUATIONS, PROBLEM.parameters, PROBLEM.initial, ROWS[:, 0], method=method, rtol=1e-9, atol=1e-10
    )
    known = ROWS[:, 1:]
    half_a_unit = 0.5 * 10.0 ** (np.floor(np.log10(np.abs(known))) - 4)
    assert (np.abs(motion.states[:, :3] - known) <= half_a_unit + 1e-5).all()


def test_the_loop_stays_closed() -> None:
    motion = simulate(EQUATIONS, PROBLEM.parameters, PROBLEM.initial, (0, 10), rtol=1e-4, atol=1e-4)
    assert motion.constraint_drift < 1e-10
    assert motion.constraint_rate_drift < 1e-10


@pytest.mark.parametrize("parameters", [PROBLEM.parameters, UNDAMPED], ids=["damped", "undamped"])
def test_energy_is_kept_but_for_the_work_of_loads(parameters: dict) -> None:  # type: ignore[type-arg]
    motion = simulate(EQUATIONS, parameters, PROBLEM.initial, (0, 10), rtol=1e-10)
    assert motion.energy_drift < 1e-9


def test_without_a_damper_kinetic_energy_comes_from_spring_and_push() -> None:
    motion = simulate(EQUATIONS, UNDAMPED, PROBLEM.initial, (0, 10), rtol=1e-10, atol=1e-12)
    q, (x, p) = motion.states.T[:3], motion.states.T[1:3]
    k, l0, F, J1, m2, J2 = (NUMBERS["parameters"][name] for name in ("k", "l0", "F", "J1", "m2", "J2"))
    kinetic = np.array([J1, m2, J2]) @ motion.states.T[3:] ** 2 / 2
    energy = kinetic + k * (length(q) - l0) ** 2 / 2 - F * (x + np.cos(p))
    assert np.ptp(energy) < 1e-9 * np.abs(kinetic).max()
