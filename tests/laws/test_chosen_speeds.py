"""Speeds of the user's choice on random systems: the chain rule from the rates of coordinates, by value."""

from __future__ import annotations

from random import Random

import pytest

from symbody import (
    Body,
    Matrix,
    System,
    Vector,
    functions_of_time,
    ground,
    jacobian,
    moving_frame,
    newton_euler,
    rotate,
    sin,
    substitute,
    symbols,
    t,
    time_derivative,
    translate,
)
from tests.laws.random_speeds import KINDS, by_chosen_speeds, drawn
from tests.laws.random_system import random_system
from tests.laws.test_formalisms import check_same_nodes

SEEDS = range(10)
a, b = symbols("a_y b_y")


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


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("seed", range(6))
def test_all_formalisms_give_the_same_nodes(seed: int, kind: str) -> None:
    system = drawn(seed, kind)
    assert system.chosen
    check_same_nodes(system)


@pytest.mark.parametrize("seed", range(6))
def test_moving_frames_may_hold_rates_that_are_written_by_speeds(seed: int) -> None:
    """A twist by a rate is the same as one by the speeds that give the rate, in every formalism."""
    random = Random(seed)
    s, u, w = functions_of_time("s u w")
    rate = 2 * u + s * w * random.randint(0, 1) + a * t
    pose = translate(*functions_of_time("x y"), 0) * rotate("Z", functions_of_time("th"))
    by_rate, by_speeds = (
        moving_frame(v, 0, 0, 0, 0, w + b * v, pose=pose) for v in (time_derivative(s), rate)
    )
    systems = [
        System(
            [Body(frame * rotate("X", s) * translate(0, 1, b), *symbols("m I_x I_y I_z"))],
            (),
            [s],
            gravity=Vector(ground, 0, symbols("g"), 0),
            speeds=[u, w],
            kinematics={time_derivative(s): rate},
        )
        for frame in (by_rate, by_speeds)
    ]
    one, two = map(newton_euler, systems)
    assert one.residuals == two.residuals
    assert one.mass_matrix == two.mass_matrix
    check_same_nodes(systems[0])
