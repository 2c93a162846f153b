"""Dynamics of a quadruped whose base moves by angles, against Pinocchio and MuJoCo at all given states."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from numpy.typing import ArrayLike

from symbody import Equations, System, lagrange_equations, lambdify, newton_euler
from tests.reference.floating_base import floating_state, robot_on_angles

TOLERANCE = 1e-12


def assert_close(value: ArrayLike, reference: ArrayLike) -> None:
    assert np.max(np.abs(np.subtract(value, reference))) <= TOLERANCE * np.max(np.abs(reference))


@pytest.mark.parametrize("formalism", [newton_euler, lagrange_equations])
def test_solo12(formalism: Callable[[System], Equations]) -> None:
    model = robot_on_angles("solo12_floating")
    equations = formalism(model.system)
    arguments = [equations.coordinates, equations.speeds, equations.accelerations]
    evaluate = lambdify(
        arguments, [equations.mass_matrix, list(equations.forcing), list(equations.residuals)]
    )
    for reference in model.states:
        state = floating_state(reference)
        mass_matrix, forcing, force = evaluate(state.q, state.u, state.a)
        assert_close(mass_matrix, state.mass_matrix)
        assert_close(forcing, state.forcing)
        assert_close(force, state.inverse_dynamics)
