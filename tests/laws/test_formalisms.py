"""Several formalisms, one system: the same nodes. And what every derivation must satisfy, whatever made it."""

from __future__ import annotations

import pytest

from symbody import (
    Equations,
    Expr,
    System,
    dot,
    generalized_force,
    gibbs_appell,
    gradient,
    gravitational_energy,
    jacobian,
    kane,
    kinetic_energy,
    lagrange,
    lagrange_equations,
    newton_euler,
    number,
    power,
    velocity,
)
from symbody.symbolic import time_derivative
from tests.laws.random_system import random_constrained_system, random_system
from tests.repeated import repeated

SEEDS = [*range(6), *repeated(range(6, 30))]
SYSTEMS = [
    *((seed, symbolic) for seed in range(6) for symbolic in (True, False)),
    *repeated((seed, symbolic) for seed in range(6, 30) for symbolic in (True, False)),
]
FORMALISMS = (newton_euler, lagrange_equations, kane, gibbs_appell)


def ids(expressions: tuple[Expr, ...]) -> list[int]:
    return [expression.id for expression in expressions]


@pytest.mark.parametrize(("seed", "symbolic"), SYSTEMS)
def test_all_formalisms_give_the_same_nodes(seed: int, symbolic: bool) -> None:
    check_same_nodes(random_system(seed, symbolic=symbolic))


def check_same_nodes(system: System) -> None:
    """The residuals, the mass matrix and the bias by every formalism."""
    first, *others = (formalism(system) for formalism in FORMALISMS)
    for other in others:
        assert ids(other.residuals) == ids(first.residuals)
        assert ids(other.mass_matrix.entries) == ids(first.mass_matrix.entries)
        assert ids(other.bias) == ids(first.bias)


@pytest.mark.parametrize("seed", [*range(4), *repeated(range(4, 20))])
@pytest.mark.parametrize("floats", [False, True])
def test_with_constraints_too(seed: int, floats: bool) -> None:
    """Loops, and conditions on velocities; trees that float, and others."""
    system = random_constrained_system(seed, floats=floats)
    assert len(system.holonomic) == 1
    assert len(system.constraints) == 2
    check_same_nodes(system)


@pytest.mark.parametrize(("seed", "symbolic"), SYSTEMS)
def test_the_residuals_are_linear_in_the_accelerations(seed: int, symbolic: bool) -> None:
    equations = newton_euler(random_system(seed, symbolic=symbolic))
    M = equations.mass_matrix
    assert M == M.T
    assert jacobian(equations.residuals, equations.accelerations) == M
    at_rest = dict.fromkeys(equations.accelerations, 0)
    assert tuple(residual.subs(at_rest) for residual in equations.residuals) == equations.bias
    assert equations.forcing == tuple(-entry for entry in equations.bias)


@pytest.mark.parametrize("seed", SEEDS)
def test_lagrange_by_hand(seed: int) -> None:
    """d/dt dL/dq' - dL/dq - Q from the energies in ground, with nothing of the recursion."""
    system = random_system(seed)
    L = kinetic_energy(system) - gravitational_energy(system)
    forces = generalized_force(system.loads, system.coordinates)
    by_hand = [lagrange(L, q) - Q for q, Q in zip(system.coordinates, forces, strict=True)]
    assert list(newton_euler(system).residuals) == by_hand


@pytest.mark.parametrize("seed", SEEDS)
def test_the_mass_matrix_is_that_of_the_kinetic_energy(seed: int) -> None:
    system = random_system(seed)
    equations = newton_euler(system)
    momenta = gradient(kinetic_energy(system), equations.speeds)
    assert jacobian(momenta, equations.speeds) == equations.mass_matrix


def moving_along(equations: Equations) -> Expr:
    """Return the power of the residuals along the speeds."""
    return sum((r * u for r, u in zip(equations.residuals, equations.speeds, strict=True)), start=number(0))


def is_scleronomic(system: System) -> bool:
    return not any(
        leaf.name == "t" for body in system.bodies for motion in body.frame.motions for leaf in motion.leaves
    )


@pytest.mark.parametrize("seed", [seed for seed in range(20) if is_scleronomic(random_system(seed))])
def test_power_of_the_loads_is_the_rate_of_the_energy(seed: int) -> None:
    """dE/dt - P = residuals . q' for systems that nothing drives."""
    system = random_system(seed)
    assert system.gravity is not None
    falls = (body.mass * dot(velocity(body.center_of_mass), system.gravity) for body in system.bodies)
    weight = sum(falls, start=number(0))
    loads = sum((power(load) for load in system.loads), start=number(0))
    assert time_derivative(kinetic_energy(system)) - weight - loads == moving_along(newton_euler(system))
    assert time_derivative(gravitational_energy(system)) == -weight
