"""Laws of constraints on positions and velocities, over random trees: forces, levels, and ways of solution."""

from __future__ import annotations

import warnings
from functools import cache
from itertools import count
from random import Random

import numpy as np
import pytest

from symbody import (
    Body,
    Equations,
    Expr,
    ModelNotice,
    System,
    cos,
    floating_frame,
    forward_dynamics,
    functions_of_time,
    gradient,
    jacobian,
    lagrange_equations,
    lambdify,
    newton_euler,
    number,
    sin,
    substitute,
    symbols,
    time_derivative,
)
from symbody.symbolic import free_symbols, t
from tests.laws.random_system import random_floating_system, random_system
from tests.repeated import repeated

SEEDS = [*range(3), *repeated(range(3, 12))]
KINDS = ("position", "velocity", "both")


def condition_on_position(draw: Random, system: System) -> Expr:
    q, r = draw.choices(system.coordinates, k=2)
    a, b = symbols("a b")
    return draw.choice([q + a * sin(r) - b, q**2 + cos(r) - a * b, q - a * r + b * t])


def condition_on_velocity(draw: Random, system: System) -> Expr:
    u, v = draw.choices([*system.speeds, *map(time_derivative, system.coordinates)], k=2)
    q, r = draw.choices(system.coordinates, k=2)
    c, d = symbols("c d")
    return draw.choice([u * cos(q) - c * v * sin(r), u - c * q * v + d, c * u + v * (1 + q**2) - sin(d * t)])


def constrained(seed: int, kind: str, *, floats: bool) -> System:
    """Return a random tree with one or two random constraints."""
    draw = Random(seed)
    tree = random_floating_system(seed, symbolic=False) if floats else random_system(seed, symbolic=False)
    makers = {"position": [condition_on_position], "velocity": [condition_on_velocity]}
    conditions = [
        make(draw, tree) for make in makers.get(kind, [condition_on_position, condition_on_velocity])
    ]
    return with_constraints(tree, conditions)


def with_constraints(tree: System, conditions: list[Expr]) -> System:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ModelNotice)
        return System(
            tree.bodies, tree.loads, tree.coordinates, conditions, tree.gravity, speeds=tree.quasi_velocities
        )


@cache
def derived(seed: int, kind: str, *, floats: bool = False) -> Equations:
    """Return the equations of the first system from a seed on that has masses, a motion, and regular constraints."""
    for attempt in count(100 * seed):
        system = constrained(attempt, kind, floats=floats)
        if len(system.constraints) < len(system.speeds):
            with warnings.catch_warnings():
                warnings.simplefilter("ignore", ModelNotice)
                eqs = newton_euler(system)
            M, A = eqs.mass_matrix, eqs.constraint_jacobian
            if M == M.T and M.rank() == M.rows and A.rank() == A.rows:
                return eqs
    raise AssertionError


def at_random_points(eqs: Equations, expressions: list[Expr], count: int = 3) -> np.ndarray:
    names = sorted(free_symbols(expressions), key=str)
    values = np.random.Generator(np.random.PCG64(2)).uniform(0.3, 1.2, (len(names), count))
    return np.array(lambdify([*names], expressions)(*values))


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("seed", SEEDS)
def test_both_formalisms_give_the_same_nodes(seed: int, kind: str) -> None:
    one = derived(seed, kind)
    two = lagrange_equations(one.system)
    assert [e.id for e in one.residuals] == [e.id for e in two.residuals]


@pytest.mark.parametrize("floats", [False, True])
@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("seed", SEEDS)
def test_forces_and_levels(seed: int, kind: str, floats: bool) -> None:
    """The forces are A^T lambda, with A the slopes of the constraints on the levels of velocities and accelerations."""
    eqs = derived(seed, kind, floats=floats)
    system, A = eqs.system, eqs.constraint_jacobian
    levels = system.velocity_level(eqs.constraints)
    assert jacobian(levels, eqs.speeds) == A
    assert jacobian(system.rate(levels), eqs.accelerations) == A
    for k, u in enumerate(eqs.residuals):
        slopes = gradient(u, eqs.multipliers)
        assert [-slope for slope in slopes] == [A[i, k] for i in range(len(eqs.multipliers))]
    on_position = [eqs.constraints[k] for k in system.holonomic]
    assert system.rate(on_position) == tuple(levels[k] for k in system.holonomic)


@pytest.mark.parametrize("floats", [False, True])
@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("seed", SEEDS)
def test_accelerations_keep_the_constraints_and_the_equations(seed: int, kind: str, floats: bool) -> None:
    eqs = derived(seed, kind, floats=floats)
    solution = forward_dynamics(eqs, method="pivoted")
    found = dict(zip(eqs.accelerations, solution.accelerations, strict=True))
    found |= dict(zip(eqs.multipliers, solution.multipliers, strict=True))
    levels = eqs.system.rate(eqs.system.velocity_level(eqs.constraints))
    left = at_random_points(eqs, [*substitute([*eqs.residuals, *levels], found), *solution.accelerations])
    assert np.isfinite(left).all()
    n = len(eqs.residuals) + len(levels)
    assert np.abs(left[:n]).max() < 1e-8 * max(1.0, np.abs(left[n:]).max())


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("seed", SEEDS)
def test_all_ways_of_solution_agree(seed: int, kind: str) -> None:
    """Multipliers by elimination, independent speeds, and the whole system with pivoting."""
    eqs = derived(seed, kind)
    ways = [forward_dynamics(eqs, method=way) for way in ("schur_complement", "null_space", "pivoted")]
    values = [[*way.accelerations, *way.multipliers] for way in ways]
    one, two, three = np.split(at_random_points(eqs, [each for way in values for each in way]), 3)
    scale = max(1.0, float(np.abs(three).max()))
    assert np.abs(one - three).max() < 1e-8 * scale
    assert np.abs(two - three).max() < 1e-8 * scale


@pytest.mark.parametrize("seed", SEEDS)
def test_a_rate_constrains_as_its_integral_does(seed: int) -> None:
    """``phi' = 0`` as a condition on velocities has the residuals and the accelerations of ``phi = 0``."""
    eqs = derived(seed, "position")
    system = eqs.system
    (rate,) = system.rate(system.constraints)
    other = newton_euler(with_constraints(system, [rate]))
    assert other.residuals == eqs.residuals
    assert other.constraint_jacobian == eqs.constraint_jacobian
    assert forward_dynamics(other).accelerations == forward_dynamics(eqs).accelerations


def test_constraints_on_the_speeds_of_a_moving_frame() -> None:
    """A frame that moves by six speeds, of which two are zero, is one that moves by four."""
    base = floating_frame("body")
    m, J, K, L = symbols("m J K L")
    free = System([Body(base, m, J, K, L)])
    u, v = free.speeds[0], free.speeds[4]
    eqs = newton_euler(System([Body(base, m, J, K, L)], constraints=[u, v - number(2)]))
    accelerations = dict(zip(eqs.accelerations, forward_dynamics(eqs).accelerations, strict=True))
    assert accelerations[time_derivative(u)].is_zero
    assert accelerations[time_derivative(v)].is_zero
    assert functions_of_time("lambda1") in eqs.multipliers
