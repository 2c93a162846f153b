"""Linear models are the tangents of the nonlinear equations: over random trees, loops, speeds, constraints and states.

A random position is made one of rest: forces along all coordinates hold it, and random multipliers act in it, so that
the change of the directions of constraints is felt.
"""

from __future__ import annotations

from random import Random
from typing import NamedTuple

import numpy as np
import pytest
from numpy.testing import assert_allclose
from numpy.typing import NDArray
from scipy.linalg import eig

from symbody import (
    Equations,
    Expr,
    Linear,
    cos,
    equations_of,
    functions_of_time,
    linearize,
    newton_euler,
    number,
    sin,
    state_space,
    substitute,
    symbols,
    time_derivative,
)
from symbody.simulation.linear.matrices import second_order_matrices
from symbody.symbolic import free_symbols
from tests.laws.finite_differences import assert_tangent
from tests.laws.random_speeds import by_chosen_speeds
from tests.laws.random_system import random_constrained_system, random_floating_system, random_system
from tests.repeated import repeated


class Held(NamedTuple):
    """Equations with a position of rest.

    Attributes:
        eqs: the equations, with forces T along all speeds as inputs.
        about: the position of rest, with symbols for what holds it.
        parameters: the values of all parameters.
        reference: the values of all variables.
    """

    eqs: Equations
    about: dict[Expr, Expr]
    parameters: dict[Expr, float]
    reference: dict[Expr, float]


def held(eqs: Equations, random: Random, *, with_state: bool) -> Held:
    """Return equations that rest at a random position, on shifted constraints."""
    system = eqs.system
    n, z = len(eqs.speeds), functions_of_time("z_held")
    forces = [functions_of_time(f"T_{k}") for k in range(n)]
    shifts = [symbols(f"shift_{k}") for k in range(len(eqs.constraints))]
    u = eqs.speeds[0]
    rate = sin(z) - z + 2 * u + cos(eqs.coordinates[0]) * time_derivative(u) / 3
    for multiplier in eqs.multipliers[:1]:
        rate += multiplier / 5
    shift_z = symbols("shift_z")
    states = {z: rate + shift_z} if with_state else {}
    f = [
        one + T + (z * eqs.coordinates[-1] if with_state and k == 0 else 0)
        for k, (one, T) in enumerate(zip(eqs.forcing, forces, strict=True))
    ]
    conditions = [
        each + shift if k in system.holonomic else substitute([each], {symbols("rate"): 0})[0]
        for k, (each, shift) in enumerate(zip(eqs.constraints, shifts, strict=True))
    ]
    made = equations_of(
        eqs.mass_matrix,
        f,
        eqs.coordinates,
        constraints=conditions,
        speeds=system.quasi_velocities,
        kinematics={time_derivative(q): rate for q, rate in system.coordinate_rates.items()},
        multipliers=eqs.multipliers,
        inputs=forces,
        states=states,
    )
    q = {name: random.uniform(-1, 1) for name in eqs.coordinates}
    values = {z: random.uniform(-1, 1)} if with_state else {}
    holding = {symbols(f"tau_{k}"): T for k, T in enumerate(forces)}
    solved = {*holding, *shifts, shift_z}
    p = {name: random.uniform(0.5, 1.5) for name in made.parameters if name not in solved}
    p |= {name: random.uniform(0.5, 1.5) for name in eqs.parameters if name not in p}
    pulls = {name: random.uniform(-2, 2) for name in eqs.multipliers}
    known = {**q, **values, **p, **pulls} | dict.fromkeys((*eqs.speeds, *eqs.accelerations), 0.0)
    known |= dict.fromkeys([*shifts, shift_z, *forces], 0.0)
    residuals, offsets, drift = (
        [each.evaluate({name: known[name] for name in free_symbols([each])}) for each in part]
        for part in (
            made.residuals,
            made.system.by_speeds(made.constraints),
            [*made.state_rates.values()],
        )
    )
    p |= dict(zip(holding, residuals, strict=True)) | {s: -v for s, v in zip(shifts, offsets, strict=True)}
    p |= {shift_z: -drift[0]} if with_state else {}
    own = {name: symbols(f"at_{name}") for name in (*q, *values)}
    about = {**own, **{T: tau for tau, T in holding.items()}}
    p |= {own[name]: value for name, value in (*q.items(), *values.items())}
    reference = {**q, **values} | dict.fromkeys(eqs.speeds, 0.0)
    reference |= {T: p[tau] for tau, T in holding.items()}
    return Held(made, about, p, reference)


MAKE = {
    "tree": random_system,
    "floating": random_floating_system,
    "constrained": random_constrained_system,
    "floating and constrained": lambda seed: random_constrained_system(seed, floats=True),
}
"""Random systems by kind."""


FEW = {
    "tree": (4, 8),
    "floating": (3, 8),
    "constrained": (4,),
    "floating and constrained": (5,),
}
MORE = {
    "tree": (0, 2),
    "floating": (5, 7),
    "constrained": (0, 2, 9, 13),
    "floating and constrained": (3, 7, 9),
}
"""Seeds of systems that nothing drives in time, and whose mass matrices are regular."""

CASES = [
    *((kind, seed) for kind, seeds in FEW.items() for seed in seeds),
    *repeated((kind, seed) for kind, seeds in MORE.items() for seed in seeds),
]


def drawn(kind: str, seed: int) -> Held:
    """Return a random system that is held at rest; every third one has other speeds, every second one a state."""
    random, system = Random(seed), MAKE[kind](seed)
    if seed % 3 == 1:
        system = by_chosen_speeds(system, random, defined=seed % 2 == 1, drift=False)
    return held(newton_euler(system), random, with_state=seed % 2 == 0)


@pytest.mark.parametrize(("kind", "seed"), CASES)
def test_linear_models_are_tangents(kind: str, seed: int) -> None:
    case = drawn(kind, seed)
    outputs = [
        time_derivative(case.eqs.speeds[-1]),
        sum(case.eqs.coordinates, start=number(0)) ** 2,
        *case.eqs.multipliers,
    ]
    linear = linearize(case.eqs, case.about, outputs=outputs)
    assert_tangent(case.eqs, linear, case.parameters, case.reference, outputs)


def ordered(values: NDArray[np.complex128]) -> NDArray[np.complex128]:
    """Return eigenvalues in an order that rounding doesn't change."""
    return values[np.lexsort((values.imag, values.real.round(6)))]


def eigenvalues(linear: Linear, case: Held) -> NDArray[np.complex128]:
    return ordered(np.linalg.eigvals(state_space(linear, case.parameters).A))


@pytest.mark.parametrize(("kind", "seed"), [("tree", 3), ("constrained", 3), *repeated([("constrained", 9)])])
def test_any_independent_variables_have_the_same_eigenvalues(kind: str, seed: int) -> None:
    case = drawn(kind, seed)
    first = linearize(case.eqs, case.about)
    other = [*reversed(case.eqs.coordinates)][: len(first.coordinates)]
    chosen = linearize(case.eqs, case.about, independent=other)
    assert {*chosen.coordinates} == {*other}
    found, expected = (eigenvalues(linear, case) for linear in (chosen, first))
    assert_allclose(found, expected, rtol=1e-7, atol=1e-7 * np.abs(expected).max())


@pytest.mark.parametrize(("kind", "seed"), [("tree", 3), ("tree", 9), ("tree", 13)])
def test_eigenvalues_are_those_of_second_order(kind: str, seed: int) -> None:
    """``det(M s^2 + C s + K) = 0`` for the eigenvalues s of A."""
    case = drawn(kind, seed)
    linear = linearize(case.eqs, case.about)
    form = second_order_matrices(linear, case.parameters)
    n = len(form.M)
    left = np.block([[np.zeros((n, n)), np.eye(n)], [-form.K, -form.C]])
    right = np.block([[np.eye(n), np.zeros((n, n))], [np.zeros((n, n)), form.M]])
    expected, found = ordered(eig(left, right, right=False)), eigenvalues(linear, case)
    assert_allclose(found, expected, rtol=1e-7, atol=1e-7 * np.abs(expected).max())
