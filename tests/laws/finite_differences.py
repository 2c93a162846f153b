"""Finite differences of nonlinear equations in machine code: what linear models are compared with."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.testing import assert_allclose
from numpy.typing import NDArray

from symbody import (
    Equations,
    Expr,
    Linear,
    consistent_state,
    forward_dynamics,
    lambdify,
    state_space,
    time_derivative,
)

STEP = 2e-4
Array = NDArray[np.float64]
Numbers = Mapping[Expr, float]


class NonlinearRates:
    """The rates of the state of a linear model, and its outputs, by the nonlinear equations of motion."""

    def __init__(self, eqs: Equations, linear: Linear, outputs: Sequence[Expr], parameters: Numbers) -> None:
        self.eqs, self.linear = eqs, linear
        solution = forward_dynamics(eqs)
        rates = {**eqs.kinematics, **dict(zip(eqs.accelerations, solution.accelerations, strict=True))}
        rates |= eqs.state_rates
        wanted = [rates[time_derivative(x)] for x in linear.states]
        expressions = solution.put_into(eqs, [*wanted, *eqs.system.by_speeds([*outputs])])
        self.state = (*eqs.coordinates, *eqs.speeds, *eqs.states)
        self.parameters = {name: parameters[name] for name in eqs.parameters}
        self.names = tuple(name for name in eqs.parameters if name not in linear.inputs)
        self.function = lambdify([*self.state, *linear.inputs, *self.names], expressions)

    def at(self, x: Numbers, inputs: Numbers, near: Numbers) -> Array:
        """Return the rates and outputs at values of the independent variables; the others follow from constraints."""
        given = {r: value for r, value in inputs.items() if r.kind == "time_function"}
        parameters = self.parameters | {r: value for r, value in inputs.items() if r not in given}
        guess = {name: value for name, value in near.items() if name not in x}
        state = consistent_state(self.eqs, parameters, x, guess=guess, inputs=given)
        values = [state[name] for name in self.state] + [inputs[r] for r in self.linear.inputs]
        return np.array(self.function(*values, *(self.parameters[name] for name in self.names)))


def assert_tangent(
    eqs: Equations,
    linear: Linear,
    parameters: Numbers,
    reference: Numbers,
    outputs: Sequence[Expr] = (),
    *,
    tolerance: float = 1e-6,
) -> None:
    """Check that A, B, C and D are the central differences (of fourth order) of the nonlinear equations.

    Args:
        eqs: the nonlinear equations.
        linear: their linear model.
        parameters: the values of all parameters.
        reference: the values of coordinates, speeds, states and inputs in the steady motion.
        outputs: the outputs of the linear model.
        tolerance: the largest difference, relative to the largest entry of the same matrix.
    """
    rates = NonlinearRates(eqs, linear, outputs, parameters)
    x = {name: reference[name] for name in linear.states}
    r = {name: reference.get(name, parameters.get(name, 0.0)) for name in linear.inputs}
    near = {name: reference[name] for name in (*eqs.coordinates, *eqs.speeds)}
    found = state_space(linear, parameters)
    n = len(linear.states)
    columns = []
    for values, name in [(x, name) for name in x] + [(r, name) for name in r]:
        start = values[name]
        ends = []
        for step in (-2, -1, 1, 2):
            values[name] = start + step * STEP
            ends.append(rates.at(x, r, near))
        values[name] = start
        columns.append((ends[0] - 8 * ends[1] + 8 * ends[2] - ends[3]) / (12 * STEP))
    slopes = np.array(columns).T
    for block, expected in (
        (found.A, slopes[:n, :n]),
        (found.B, slopes[:n, n:]),
        (found.C, slopes[n:, :n]),
        (found.D, slopes[n:, n:]),
    ):
        size = np.abs(expected).max(initial=1.0)
        assert_allclose(block, expected, rtol=0, atol=tolerance * size)
