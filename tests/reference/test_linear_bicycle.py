"""The benchmark bicycle, linearised from its full nonlinear model with constraints on velocities.

Meijaard, Papadopoulos, Ruina & Schwab, Linearized dynamics equations for the balance and steer of a bicycle, 2007:
``M q'' + v C1 q' + (g K0 + v^2 K2) q = f`` with the lean and the steering angle, 14 digits, and the eigenvalues.
"""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest
from numpy.testing import assert_allclose
from numpy.typing import NDArray

from symbody import Expr, Linear, Matrix, diff, linearize, newton_euler, state_space, symbols, time_derivative
from symbody.models import bicycle
from tests.reference.mechanisms.problem import reference

NUMBERS = reference("bicycle")
BICYCLE = bicycle()
lean, steer, rear = (BICYCLE[name] for name in ("lean", "steer", "rear_angle"))
v, g = symbols("v"), BICYCLE["g"]
ANGLES = (lean, steer, time_derivative(lean), time_derivative(steer))


@cache
def straight() -> Linear:
    """Return the linear model of lean and steering at the speed v."""
    forward = {time_derivative(rear): -v / BICYCLE["rR"]}
    return linearize(newton_euler(BICYCLE.system), about=forward).part(ANGLES)


def numbers(matrix: Matrix, **values: float) -> NDArray[np.float64]:
    known: dict[Expr, float] = {
        **BICYCLE.parameters,
        **{symbols(name): value for name, value in values.items()},
    }
    return np.array([[entry.evaluate(known) for entry in row] for row in matrix.tolist()])


def test_matrices() -> None:
    linear = straight()
    assert linear.second_order.coordinates == (lean, steer)
    assert linear.conditions == ()
    C1, K0 = linear.second_order.C.diff(v), linear.K.diff(g)
    K2 = linear.K.diff(v, 2) / 2
    assert v * C1 == linear.second_order.C
    assert g * K0 + v**2 * K2 == linear.K
    for matrix, name in ((linear.M, "M"), (C1, "C1"), (K0, "K0"), (K2, "K2")):
        assert_allclose(numbers(matrix, v=3.0), NUMBERS[name], rtol=1e-11, atol=1e-12)
    assert linear.second_order.F.tolist() == [[1, 0], [0, 1]]


def test_what_does_not_matter() -> None:
    linear = linearize(newton_euler(BICYCLE.system), about={time_derivative(rear): -v / BICYCLE["rR"]})
    assert [str(q) for q in linear.ignorable] == ["x", "y", "yaw", "rear_angle", "front_angle"]
    assert diff(linear.about[time_derivative(BICYCLE["x"])], v) == 1


def test_eigenvalues() -> None:
    speeds = [row["v"] for row in NUMBERS["eigenvalues"]]
    found = np.linalg.eigvals(state_space(straight(), {**BICYCLE.parameters, v: speeds}).A)
    expected = [[complex(*each) for each in row["published"]] for row in NUMBERS["eigenvalues"]]
    assert_allclose(np.sort_complex(found), np.sort_complex(expected), rtol=1e-11, atol=1e-11)


@pytest.mark.parametrize("name", ["weave", "capsize"])
def test_speeds_at_which_stability_changes(name: str) -> None:
    found = np.linalg.eigvals(state_space(straight(), {**BICYCLE.parameters, v: NUMBERS["speeds"][name]}).A)
    assert np.abs(found.real).min() < 1e-11
