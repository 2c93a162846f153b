"""The lengths of equations: bounds that no change may pass, and what is linear stays linear."""

from __future__ import annotations

import pytest

from symbody import Cost, Equations, System, cost, lagrange_equations, newton_euler
from tests.dynamics.models import cart_pendulum, chain, gimbal_chain


def assembled(equations: Equations) -> Cost:
    return cost([*equations.mass_matrix.entries, *equations.bias])


def test_a_chain_of_a_hundred_bodies() -> None:
    """At most 7894 additions and 9590 multiplications, and Lagrange's equations are the same nodes."""
    system = chain(100)
    one, two = newton_euler(system), lagrange_equations(system)
    assert [e.id for e in one.residuals] == [e.id for e in two.residuals]
    count = cost(one.residuals)
    assert count.additions <= 7894
    assert count.multiplications <= 9590


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
    system = make(4)
    one, two = newton_euler(system), lagrange_equations(system)
    assert [e.id for e in one.residuals] == [e.id for e in two.residuals]
    assert [e.id for e in one.mass_matrix.entries] == [e.id for e in two.mass_matrix.entries]
    assert [e.id for e in one.bias] == [e.id for e in two.bias]


def test_a_chain_of_five_hundred_bodies() -> None:
    assert len(newton_euler(chain(500)).residuals) == 500
