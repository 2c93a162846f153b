"""The way of modelling doesn't matter: the same mechanism in the same coordinates has equations of the same length.

The mechanisms, and the four ways in which each is modelled, are in `ways_of_modelling.py`.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import cache

import pytest

from symbody import (
    Body,
    Equations,
    Expr,
    System,
    cost,
    forward_dynamics,
    functions_of_time,
    lagrange_equations,
    newton_euler,
    rotate,
    symbols,
    translate,
)
from symbody.dynamics.recursion.shortest_derivation import (
    mass_matrix_and_bias,
    residuals,
    shortest_derivation,
)
from symbody.dynamics.tree.compared_forms import compared_forms
from symbody.dynamics.tree.frame_tree import FrameTree, frame_tree, targets, tree_of_forms
from symbody.dynamics.tree.normal_frames import NormalFrames, by_base
from symbody.dynamics.tree.orientation_path import placed
from symbody.symbolic import derivation
from tests.dynamics.ways_of_modelling import (
    DOWN_Y,
    MECHANISMS,
    WAYS,
    modelled,
    pendulum_on_a_cart,
    planar_arm,
)

BOUND = 1.0
"""Of the longest form of the mass matrix and the bias over the shortest one."""

RESIDUALS = 1.0
"""The same of the residuals."""


def assembled(equations: Equations) -> tuple[Expr, ...]:
    return *equations.mass_matrix.entries, *equations.bias


@cache
def derived(name: str, way: str, formalism: Callable[[System], Equations] = newton_euler) -> Equations:
    """Return the equations of a mechanism that is modelled in one of the ways, derived once for all tests."""
    return formalism(modelled(MECHANISMS[name], way))


@pytest.mark.parametrize("name", MECHANISMS)
def test_mass_matrix_and_bias_are_equally_short(name: str) -> None:
    counts = [cost(assembled(derived(name, way))).total for way in WAYS]
    assert max(counts) <= BOUND * min(counts), counts


@pytest.mark.parametrize("name", MECHANISMS)
def test_residuals_are_equally_short(name: str) -> None:
    counts = [cost(derived(name, way).residuals).total for way in WAYS]
    assert max(counts) <= RESIDUALS * min(counts), counts


def both(name: str) -> Sequence[Callable[[System], Equations]]:
    """Return the formalisms; Lagrange's equations need rates of coordinates as speeds."""
    return [newton_euler] if MECHANISMS[name].speeds else [newton_euler, lagrange_equations]


@pytest.mark.parametrize("name", [name for name in MECHANISMS if "30" not in name])
def test_all_ways_give_the_same_values(name: str) -> None:
    """By Lagrange's equations, too, which are the same nodes in each way: see below."""
    equations = [derived(name, way) for way in WAYS]
    for other in equations[1:]:
        assert assembled(other) == assembled(equations[0])
        assert other.residuals == equations[0].residuals


def test_a_long_pendulum_has_the_same_values() -> None:
    values = [assembled(derived("pendulum of 30 links on a cart", way)) for way in WAYS]
    assert all(other == values[0] for other in values[1:])


@pytest.mark.parametrize("way", WAYS)
@pytest.mark.parametrize("name", [name for name in MECHANISMS if "30" not in name and len(both(name)) == 2])
def test_both_formalisms_give_the_same_nodes(name: str, way: str) -> None:
    one, two = derived(name, way), derived(name, way, lagrange_equations)
    assert ids(one.residuals) == ids(two.residuals)
    assert ids(assembled(one)) == ids(assembled(two))


def test_each_form_is_derived_once_and_the_shortest_derivation_goes_on() -> None:
    system = modelled(pendulum_on_a_cart(3), "chain")
    forms, derived = compared_forms(system), list[tuple[Expr, ...]]()

    def derive(system: System, tree: FrameTree) -> tuple[Expr, ...]:
        derived.append(mass_matrix_and_bias(system, tree))
        return derived[-1]

    with shortest_derivation(system, derive) as shortest:
        again = mass_matrix_and_bias(system, frame_tree(system))  # of equal values, but longer anywhere else
    counts = [cost(entries).total for entries in derived]
    assert len(derived) == len(forms) > 1
    assert len(set(counts)) == len(counts)
    assert ids(shortest) == ids(derived[counts.index(min(counts))]) == ids(again)
    with shortest_derivation(system, derive) as known:  # the choice is kept
        assert ids(known) == ids(shortest)
    assert len(derived) == len(forms) + 1


@pytest.mark.parametrize("n", [3, 5])
def test_local_axes_are_not_tried_where_they_are_longer(n: int) -> None:
    system = modelled(pendulum_on_a_cart(n), "chain")
    (places,) = by_base(placed(targets(system)))
    local = NormalFrames(places, frozenset(body.frame.key for body in system.bodies)).in_local_axes()
    assert local not in compared_forms(system)
    for derive in (residuals, mass_matrix_and_bias):
        with shortest_derivation(system, derive) as shortest:
            fewest = cost(shortest).total
        with derivation(fresh=True):
            assert cost(derive(system, tree_of_forms(system, local))).total > fewest


def ids(values: Sequence[Expr]) -> list[int]:
    return [value.id for value in values]


def test_the_pendulum_of_thirty_links_is_as_short_as_points_of_the_ground() -> None:
    equations = newton_euler(modelled(pendulum_on_a_cart(30), "chain"))
    assert cost(assembled(equations)).total <= 2141
    assert cost(equations.residuals).total <= 740


def test_an_arm_of_relative_angles_turned_back_is_solved_by_articulated_bodies() -> None:
    """The sums of angles are recognised as those of a chain, each joint of which has a coordinate of its own."""
    mechanism = planar_arm(3, relative=True)
    solutions = [
        forward_dynamics(newton_euler(modelled(mechanism, way)), method="articulated_body") for way in WAYS
    ]
    for other in solutions[1:]:
        assert other.accelerations == solutions[0].accelerations


def test_one_form_is_kept_where_no_other_is_shorter() -> None:
    """A single link whose angle is of ground is derived by its frame."""
    q, (m, l) = functions_of_time("q"), symbols("m l")
    system = System([Body(rotate("Z", q) * translate(0, -l, 0), m)], coordinates=[q], gravity=DOWN_Y)
    assert str(newton_euler(system).residuals) == "(l*m*(l*q'' + g*sin(q)),)"
