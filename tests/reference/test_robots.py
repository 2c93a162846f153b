"""Dynamics of six robots against Pinocchio and MuJoCo, at all given states.

Errors are relative to the largest entry of the reference vector or matrix, the measure by which the two reference
tools are compared too. Forward dynamics solves with the mass matrix, so its rounding errors grow with the condition
number. At most 710 for the arms (the Panda's), it leaves 1e-12 a factor of six above 710 times the machine precision.
The 31000 of Solo12 come from legs of grams on a trunk of a kilogram: scale, which elimination doesn't feel.

The base of Solo12 floats: its velocities in its own axes are speeds, as in the references, and Lagrange's equations are
not for it.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache

import numpy as np
import pytest
from numpy.typing import ArrayLike, NDArray

from symbody import (
    Equations,
    Point,
    angular_momentum,
    gibbs_appell,
    gravitational_energy,
    ground,
    kane,
    kinetic_energy,
    lagrange_equations,
    lambdify,
    linear_momentum,
    newton_euler,
    project,
    symbols,
)
from tests.reference.robot import FIXED, NAMES, motion_at, robot

TOLERANCE = 1e-12
FORMALISMS = (newton_euler, lagrange_equations, kane, gibbs_appell)
DERIVED = [(name, newton_euler) for name in NAMES] + [(name, lagrange_equations) for name in FIXED]

Formalism = Callable[..., Equations]
Values = NDArray[np.float64]


def assert_close(value: ArrayLike, reference: ArrayLike) -> None:
    reference = np.asarray(reference, float)
    error = np.max(np.abs(np.asarray(value, float) - reference))
    assert error <= TOLERANCE * np.max(np.abs(reference))


@cache
def evaluator(name: str, formalism: Formalism) -> Callable[..., tuple[Values, Values, Values]]:
    """Return (q, u, u') -> (mass matrix, bias, inverse dynamics) of the derived equations."""
    equations = formalism(robot(name).system)
    n = len(equations.speeds)
    entries = [*equations.mass_matrix.entries, *equations.forcing, *equations.residuals]
    function = lambdify([equations.coordinates, equations.speeds, equations.accelerations], entries)

    def evaluate(*state: ArrayLike) -> tuple[Values, Values, Values]:
        values = np.array(function(*state), float)
        return values[: n * n].reshape(n, n), -values[n * n : n * n + n], values[n * n + n :]

    return evaluate


@pytest.mark.parametrize(("name", "formalism"), DERIVED)
def test_mass_matrix_and_bias(name: str, formalism: Formalism) -> None:
    for state in robot(name).states:
        mass_matrix, bias, _ = evaluator(name, formalism)(*motion_at(state))
        assert_close(mass_matrix, state["mass_matrix"])
        assert_close(bias, state["bias"])


@pytest.mark.parametrize(("name", "formalism"), DERIVED)
def test_inverse_dynamics(name: str, formalism: Formalism) -> None:
    for state in robot(name).states:
        _, _, force = evaluator(name, formalism)(*motion_at(state))
        assert_close(force, state["inverse_dynamics"])


@pytest.mark.parametrize(("name", "formalism"), DERIVED)
def test_forward_dynamics(name: str, formalism: Formalism) -> None:
    for state in robot(name).states:
        q, u, a = motion_at(state)
        mass_matrix, bias, _ = evaluator(name, formalism)(q, u, np.zeros_like(a))
        acceleration = np.linalg.solve(mass_matrix, np.array(state["tau"]) - bias)
        assert_close(acceleration, state["forward_dynamics"])
        _, _, force = evaluator(name, formalism)(q, u, acceleration)
        assert_close(force, state["tau"])


@pytest.mark.parametrize("name", FIXED)
def test_all_formalisms_give_the_same_ids(name: str) -> None:
    derived = [formalism(robot(name).system) for formalism in FORMALISMS]
    entries = [[*e.residuals, *e.mass_matrix.entries, *e.forcing] for e in derived]
    first, *others = ([entry.id for entry in column] for column in entries)
    assert all(other == first for other in others)


@pytest.mark.parametrize("name", NAMES)
def test_energies_and_momenta(name: str) -> None:
    model = robot(name)
    centre = symbols("x_C y_C z_C")
    about = Point(ground, *centre)
    energies = [
        sum(kinetic_energy(body) for body in model.moving_bodies),
        sum(gravitational_energy(body, model.gravity) for body in model.moving_bodies),
    ]
    momenta = [
        component
        for momentum in (linear_momentum, lambda body: angular_momentum(body, about))
        for component in zip(
            *(project(momentum(body), ground).components for body in model.moving_bodies), strict=True
        )
    ]
    arguments = [model.system.coordinates, model.system.speeds, centre]
    function = lambdify(arguments, [*energies, *map(sum, momenta)])
    for state in model.states:
        q, u, _ = motion_at(state)
        values = function(q, u, state["com_world"])
        assert_close(values[0], state["kinetic_energy"])
        assert_close(values[1], state["potential_energy"])
        assert_close(values[2:5], state["centroidal_momentum_world_lin_ang"][:3])
        assert_close(values[5:], state["centroidal_momentum_world_lin_ang"][3:])
