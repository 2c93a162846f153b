"""Dynamics of four robots against Pinocchio and MuJoCo, at all given states, from both formalisms.

Errors are relative to the largest entry of the reference vector or matrix, the measure by which the two reference
tools are compared too. Forward dynamics solves with the mass matrix, so its rounding errors grow with the condition
number (at most 710 here, the Panda's): 1e-12 still leaves a factor of six above 710 times the machine precision.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import cache

import numpy as np
import pytest
from numpy.typing import ArrayLike, NDArray

from symbody import (
    Equations,
    Point,
    angular_momentum,
    gravitational_energy,
    ground,
    kinetic_energy,
    lagrange_equations,
    lambdify,
    linear_momentum,
    newton_euler,
    project,
    symbols,
)
from symbody.symbolic import Expr, t
from tests.reference.robot import NAMES, Robot, robot

TOLERANCE = 1e-12
FORMALISMS = (newton_euler, lagrange_equations)

Formalism = Callable[..., Equations]
Values = NDArray[np.float64]


def assert_close(value: ArrayLike, reference: ArrayLike) -> None:
    reference = np.asarray(reference, float)
    error = np.max(np.abs(np.asarray(value, float) - reference))
    assert error <= TOLERANCE * np.max(np.abs(reference))


@cache
def evaluator(name: str, formalism: Formalism) -> Callable[..., tuple[Values, Values, Values]]:
    """Return (q, q', q'') -> (mass matrix, bias, inverse dynamics) of the derived equations."""
    model = robot(name)
    equations = formalism(model.system)
    n = len(model.coordinates)
    entries = [*equations.mass_matrix.entries, *equations.forcing, *equations.residuals]
    function = lambdify(arguments(model), entries)

    def evaluate(*state: ArrayLike) -> tuple[Values, Values, Values]:
        values = np.array(function(*state), float)
        return values[: n * n].reshape(n, n), -values[n * n : n * n + n], values[n * n + n :]

    return evaluate


def arguments(model: Robot) -> list[Sequence[Expr]]:
    return [[q.diff(t, order) if order else q for q in model.coordinates] for order in range(3)]


@pytest.mark.parametrize("formalism", FORMALISMS)
@pytest.mark.parametrize("name", NAMES)
def test_mass_matrix_and_bias(name: str, formalism: Formalism) -> None:
    for state in robot(name).states:
        mass_matrix, bias, _ = evaluator(name, formalism)(
            state["joint_q"], state["joint_v"], state["joint_a"]
        )
        assert_close(mass_matrix, state["mass_matrix"])
        assert_close(bias, state["bias"])


@pytest.mark.parametrize("formalism", FORMALISMS)
@pytest.mark.parametrize("name", NAMES)
def test_inverse_dynamics(name: str, formalism: Formalism) -> None:
    for state in robot(name).states:
        _, _, force = evaluator(name, formalism)(state["joint_q"], state["joint_v"], state["joint_a"])
        assert_close(force, state["inverse_dynamics"])


@pytest.mark.parametrize("formalism", FORMALISMS)
@pytest.mark.parametrize("name", NAMES)
def test_forward_dynamics(name: str, formalism: Formalism) -> None:
    for state in robot(name).states:
        rest = np.zeros_like(state["joint_q"])
        mass_matrix, bias, _ = evaluator(name, formalism)(state["joint_q"], state["joint_v"], rest)
        acceleration = np.linalg.solve(mass_matrix, np.array(state["tau"]) - bias)
        assert_close(acceleration, state["forward_dynamics"])
        _, _, force = evaluator(name, formalism)(state["joint_q"], state["joint_v"], acceleration)
        assert_close(force, state["tau"])


@pytest.mark.parametrize("name", NAMES)
def test_both_formalisms_give_the_same_ids(name: str) -> None:
    derived = [formalism(robot(name).system) for formalism in FORMALISMS]
    entries = [[*e.residuals, *e.mass_matrix.entries, *e.forcing] for e in derived]
    one, two = ([entry.id for entry in column] for column in entries)
    assert one == two


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
    function = lambdify([*arguments(model)[:2], centre], [*energies, *map(sum, momenta)])
    for state in model.states:
        values = function(state["joint_q"], state["joint_v"], state["com_world"])
        assert_close(values[0], state["kinetic_energy"])
        assert_close(values[1], state["potential_energy"])
        assert_close(values[2:5], state["centroidal_momentum_world_lin_ang"][:3])
        assert_close(values[5:], state["centroidal_momentum_world_lin_ang"][3:])
