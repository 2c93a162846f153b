"""Speeds of the user's choice on random systems: the chain rule from the rates of coordinates, by value."""

from __future__ import annotations

from random import Random

import pytest

from symbody import (
    Body,
    Frame,
    Matrix,
    Point,
    System,
    Vector,
    functions_of_time,
    ground,
    hamilton,
    jacobian,
    lagrange_equations,
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
from tests.repeated import repeated

SEEDS = [*range(3), *repeated(range(3, 10))]
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
@pytest.mark.parametrize("seed", [0, 1, *repeated(range(2, 6))])
def test_all_formalisms_give_the_same_nodes(seed: int, kind: str) -> None:
    system = drawn(seed, kind)
    assert system.chosen
    check_same_nodes(system)


@pytest.mark.parametrize("seed", [*range(3), *repeated(range(3, 6))])
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


@pytest.mark.parametrize("seed", range(4))
def test_moving_master_frames_too(seed: int) -> None:
    """A frame whose place is unknown, and which is led by a rate that speeds give."""
    random = Random(seed)
    s, u, w = functions_of_time("s u w")
    rate = 2 * u + s * w * random.randint(0, 1) + a * t
    turning = [0, 0, 0]
    turning[random.randrange(3)] = w + b * time_derivative(s)  # type: ignore[call-overload]
    frame = moving_frame(time_derivative(s), 0, u, *turning)
    body = Body(frame * rotate("X", s) * translate(0, 1, b), *symbols("m I_x I_y I_z"))
    weight = Vector(frame, 0, symbols("g"), 0)
    check_same_nodes(
        System([body], (), [s], gravity=weight, speeds=[u, w], kinematics={time_derivative(s): rate})
    )


def test_natural_coordinates_by_the_chain_rule() -> None:
    """Frames that only constraints make rigid, in speeds of choice: Lagrange's equations alone."""
    x, y, p, q, v, w = functions_of_time("x y p q v w")
    m, J, g, l = symbols("m J g l")
    frame = Frame([[p, -q, 0, x], [q, p, 0, y], [0, 0, 1, 0], [0, 0, 0, 1]])
    bodies, rigid = [Body(frame, m, J, J, J), Body(Point(frame, l, 0, 0), 2 * m)], [p**2 + q**2 - 1]
    gravity, coordinates = Vector(ground, 0, -g, 0), [x, y, p, q]
    kinematics = {
        v: p * time_derivative(x) + q * time_derivative(y),
        w: p * time_derivative(q) - q * time_derivative(p),
    }
    plain = System(bodies, (), coordinates, rigid, gravity)
    chosen = System(bodies, (), coordinates, rigid, gravity, kinematics=kinematics)
    one, two = lagrange_equations(plain), lagrange_equations(chosen)
    Y = jacobian(list(chosen.kinematics.values()), chosen.speeds)
    residuals = Matrix([[entry] for entry in chosen.by_speeds(one.residuals)])
    assert two.residuals == (Y.T @ residuals).entries
    assert two.mass_matrix == Y.T @ one.mass_matrix @ Y
    found = hamilton(chosen)
    known = found.momenta_by_speeds
    changes = chosen.rate([*known.values()])
    rates = substitute([found.rates[time_derivative(each)] for each in found.momenta], known)
    assert tuple(c - r for c, r in zip(changes, rates, strict=True)) == two.residuals
