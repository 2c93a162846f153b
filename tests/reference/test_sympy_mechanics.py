"""SymPy's expectations of its own mechanics: every system of its tests that the file holds, built and derived here.

The definitions of the systems are those of the tests in SymPy 1.14, which are all complete. Results are compared as
expressions, so that the signs and the order of SymPy's equations are put in where they differ; the expressions are
checked at the file's random points. Three expectations are no principle of mechanics. `test_disc_of_sympy.py` has them.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache, partial

import pytest

from tests.reference.mechanisms.sympy_expectation import QUANTITIES, Derived, assert_expected
from tests.reference.mechanisms.sympy_joints import (
    chaos_pendulum,
    pin_joint,
    sliding_masses,
    spherical_joint,
)
from tests.reference.mechanisms.sympy_nonholonomic import disc_with_dependent_speeds, free_body, tricycle
from tests.reference.mechanisms.sympy_particles import (
    cartesian_pendulum,
    disc_on_an_incline,
    double_pendulum_with_interaction,
    linear_pendulum,
    masses_in_series,
    oscillator,
    pendulum,
    pendulum_on_cart,
)

SYSTEMS: dict[str, Callable[[], Derived]] = {
    "test_kane::test_one_dof": oscillator,
    "test_kane::test_pend": pendulum,
    "test_kane::test_implicit_kinematics": free_body,
    "test_kane2::test_aux_dep": disc_with_dependent_speeds,
    "test_kane2::test_sub_qdot": tricycle,
    "test_kane4::test_replace_qdots_in_force": double_pendulum_with_interaction,
    "test_lagrange::test_disc_on_an_incline_plane": disc_on_an_incline,
    "test_lagrange::test_nonminimal_pendulum": cartesian_pendulum,
    "test_linearize::test_linearize_pendulum_kane_minimal": partial(linear_pendulum, by_kane=True),
    "test_linearize::test_linearize_pendulum_lagrange_minimal": partial(linear_pendulum, by_kane=False),
    "test_jointsmethod::test_two_dof_joints": sliding_masses,
    "test_jointsmethod::test_chaos_pendulum": chaos_pendulum,
    "test_models::test_multi_mass_spring_damper_higher_order": masses_in_series,
    "test_models::test_n_link_pendulum_on_cart_higher_order": pendulum_on_cart,
    "test_joint::test_spherical_joint_orient_body": spherical_joint,
    "test_joint::test_pin_joint_axis": pin_joint,
}
"""The systems by the name of SymPy's test."""

REFUTED = {
    "test_kane::test_aux": "the acceleration of the point that touches the ground was taken for zero",
    "test_lagrange::test_rolling_disc": "the condition of rolling was substituted into the Lagrangian",
    "test_linearize::test_linearize_rolling_disc_lagrange": "it is the linear model of the one before",
}
"""The expectations that `test_disc_of_sympy.py` refutes, and why they are wrong."""

derived = cache(lambda test: SYSTEMS[test]())


def test_every_expectation_is_compared() -> None:
    assert {*SYSTEMS, *REFUTED} == {*QUANTITIES}


@pytest.mark.parametrize(
    ("test", "quantity"), [(test, quantity) for test in SYSTEMS for quantity in QUANTITIES[test]]
)
def test_expectation(test: str, quantity: str) -> None:
    assert_expected(test, quantity, derived(test))
