"""Dynamics of a quadruped with a floating base against Pinocchio and MuJoCo, at all given states."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from numpy.typing import ArrayLike

from symbody import Equations, System, lagrange_equations, lambdify, newton_euler
from symbody.symbolic import t
from tests.reference.floating_base import floating_state
from tests.reference.robot import robot

TOLERANCE = 1e-12


def assert_close(value: ArrayLike, reference: ArrayLike) -> None:
    assert np.max(np.abs(np.subtract(value, reference))) <= TOLERANCE * np.max(np.abs(reference))


@pytest.mark.parametrize("formalism", [newton_euler, lagrange_equations])
def test_solo12(formalism: Callable[[System], Equations]) -> None:
    model = robot("solo12_floating")
    equations = formalism(model.system)
    arguments = [[q.diff(t, order) if order else q for q in model.coordinates] for order in range(3)]
    evaluate = lambdify(
        arguments, [equations.mass_matrix, list(equations.forcing), list(equations.residuals)]
    )
    for reference in model.states:
        state = floating_state(reference)
        mass_matrix, forcing, force = evaluate(state.q, state.u, state.a)
        assert_close(mass_matrix, state.mass_matrix)
        assert_close(forcing, state.forcing)
        assert_close(force, state.inverse_dynamics)
