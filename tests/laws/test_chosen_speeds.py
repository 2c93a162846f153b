"""Speeds of the user's choice on random systems: the chain rule from the rates of coordinates, by value."""

from __future__ import annotations

from random import Random

import pytest

from symbody import (
    Matrix,
    System,
    cos,
    functions_of_time,
    jacobian,
    newton_euler,
    sin,
    substitute,
    symbols,
    t,
    time_derivative,
)
from tests.laws.random_system import random_system

SEEDS = range(10)
a, b = symbols("a_y b_y")


def by_chosen_speeds(system: System, random: Random, *, defined: bool) -> System:
    """Return a system with a speed for each coordinate: ``q' = Y u + b``, or ``u = Y q' + b``; Y has an inverse."""
    n = len(system.coordinates)
    speeds = [functions_of_time(f"u_{k}") for k in range(n)]
    rates = [time_derivative(q) for q in system.coordinates]
    left, right = (speeds, rates) if defined else (rates, speeds)
    kinematics = {}
    for k in range(n):
        slope = 2 + cos(random.choice(system.coordinates))
        kinematics[left[k]] = slope * right[k] + a * sin(t) * random.randint(0, 1)
        if k:
            kinematics[left[k]] += b * system.coordinates[k] * right[random.randrange(k)]
    return System(
        system.bodies,
        system.loads,
        system.coordinates,
        system.constraints,
        system.gravity,
        speeds=speeds,
        kinematics=kinematics,
        inputs=system.inputs,
    )


@pytest.mark.parametrize("defined", [False, True], ids=["rates", "definitions"])
@pytest.mark.parametrize("seed", SEEDS)
def test_residuals_and_mass_matrix_by_the_chain_rule(seed: int, *, defined: bool) -> None:
    """They are ``Y^T r`` and ``Y^T M Y`` of those by the rates of coordinates, with the rates put in."""
    system = random_system(seed)
    chosen = by_chosen_speeds(system, Random(seed), defined=defined)
    one, two = newton_euler(system), newton_euler(chosen)
    Y = jacobian(list(chosen.kinematics.values()), chosen.speeds)
    residuals = (Y.T @ Matrix([[entry] for entry in chosen.by_speeds(one.residuals)])).entries
    n = len(chosen.speeds)
    M = Matrix([list(chosen.by_speeds(one.mass_matrix.row(k))) for k in range(n)])
    assert two.residuals == residuals
    assert two.mass_matrix == Y.T @ M @ Y
    assert two.bias == substitute(residuals, dict.fromkeys(chosen.accelerations, 0))


@pytest.mark.parametrize("seed", SEEDS)
def test_constraints_of_both_kinds_by_the_chain_rule(seed: int) -> None:
    system = random_system(seed)
    q = system.coordinates
    conditions = [time_derivative(q[0]) - b * sin(q[-1]) * time_derivative(q[-1]) + a * t, q[0] ** 2 - q[-1]]
    constrained = System(system.bodies, system.loads, q, conditions, system.gravity, inputs=system.inputs)
    chosen = by_chosen_speeds(constrained, Random(seed), defined=False)
    one, two = newton_euler(constrained), newton_euler(chosen)
    Y = jacobian(list(chosen.kinematics.values()), chosen.speeds)
    assert two.constraint_jacobian == one.constraint_jacobian @ Y
    residuals = Matrix([[entry] for entry in chosen.by_speeds(one.residuals)])
    assert two.residuals == (Y.T @ residuals).entries
