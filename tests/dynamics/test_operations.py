"""The lengths of equations: bounds that no change may pass, and what is linear stays linear."""

from __future__ import annotations

import pytest

from benchmarks.derive.by_symbody import trifilar
from symbody import (
    Body,
    Cost,
    Equations,
    Point,
    System,
    cost,
    forward_dynamics,
    lagrange_equations,
    newton_euler,
    symbols,
)
from tests.dynamics.models import cart_pendulum, chain, gimbal_chain
from tests.reference.robot import robot
from tests.worksheets.test_trifilar_seed import gravity_force, solved_frame, system


def assembled(equations: Equations) -> Cost:
    return cost([*equations.mass_matrix.entries, *equations.bias])


def test_a_chain_of_a_hundred_bodies() -> None:
    """At most 7894 additions and 9590 multiplications, and Lagrange's equations are the same nodes."""
    model = chain(100)
    one, two = newton_euler(model), lagrange_equations(model)
    assert [e.id for e in one.residuals] == [e.id for e in two.residuals]
    count = cost(one.residuals)
    assert count.additions <= 7894
    assert count.multiplications <= 9590


def test_a_chain_of_thirty_bodies() -> None:
    assert cost(newton_euler(chain(30)).residuals).total <= 4427


def test_a_quadruped_afloat() -> None:
    """Solo12 by a quaternion and speeds in axes of its base: 12 joints, 17 links and all numbers folded in."""
    equations = newton_euler(robot("solo12_floating").system)
    assert cost(equations.residuals).total <= 1095
    assert cost(equations.mass_matrix).total <= 630
    assert cost(forward_dynamics(equations).accelerations).total <= 2490


@pytest.mark.parametrize("make", [chain, gimbal_chain])
def test_inverse_dynamics_is_linear(make: type[System]) -> None:
    five, ten, fifteen = (cost(newton_euler(make(n)).residuals).total for n in (5, 10, 15))
    assert abs((fifteen - ten) - (ten - five)) <= 0.04 * (ten - five)


def test_six_bodies_of_three_angles() -> None:
    assert assembled(newton_euler(gimbal_chain(6))).total < 8000


@pytest.mark.parametrize(("n", "bound"), [(10, 700), (30, 5000)])
def test_pendulum_of_n_links_on_a_cart(n: int, bound: int) -> None:
    assert assembled(newton_euler(cart_pendulum(n))).total <= bound


@pytest.mark.parametrize("make", [chain, gimbal_chain, cart_pendulum])
def test_both_formalisms_give_the_same_nodes(make: type[System]) -> None:
    model = make(4)
    one, two = newton_euler(model), lagrange_equations(model)
    assert [e.id for e in one.residuals] == [e.id for e in two.residuals]
    assert [e.id for e in one.mass_matrix.entries] == [e.id for e in two.mass_matrix.entries]
    assert [e.id for e in one.bias] == [e.id for e in two.bias]


@pytest.mark.parametrize(("own_frame", "by_hand"), [(False, 497), (True, 635)])
def test_trifilar_pendulum_has_fewer_operations_than_by_hand(own_frame: bool, by_hand: int) -> None:
    """The figures are those of CasADi, with the model written by hand in local axes."""
    assert cost(trifilar.equations(own_frame=own_frame)).total < by_hand


def test_trifilar_pendulum() -> None:
    """The worksheet's 21 equations; and those of the plate with inertia, its frame being the natural one."""
    equations = lagrange_equations(system())
    omega, zeta = symbols("omega zeta")
    assert cost([*equations.residuals, *equations.baumgarte(omega, zeta)]).total <= 600
    G = Point(solved_frame(), symbols("l") / 4, 0, 0)
    turning = Body(G, symbols("m"), *symbols("Jxx Jyy Jzz Jyz Jxz Jxy"))
    other = System([turning], [gravity_force(turning)], equations.coordinates, equations.constraints)
    equations = lagrange_equations(other)
    assert cost([*equations.residuals, *equations.baumgarte(omega, zeta)]).total <= 1500


def test_a_chain_of_five_hundred_bodies() -> None:
    assert len(newton_euler(chain(500)).residuals) == 500
