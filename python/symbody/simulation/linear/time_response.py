"""Step and impulse responses of linear models, by matrix exponentials."""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from symbody.dynamics import Linear
from symbody.errors import ArgumentError, ModelError
from symbody.simulation.motion.drawing import drawing_function
from symbody.symbolic import Expr
from symbody.symbolic.expression.html_table import html_table
from symbody.symbolic.given.arguments import counted, with_known_names

from .output_and_input import output_and_input
from .realization import realization
from .row_fault import row_fault
from .transfer import transfer

if TYPE_CHECKING:
    from matplotlib.figure import Figure

__all__ = ["TimeResponse", "impulse_response", "step_response"]

Array = NDArray[np.float64]

_INSTANTS = 1001
"""The instants of a span, as in `simulate`."""


@dataclass(frozen=True, eq=False)
class TimeResponse:
    """The outputs over time after a step or an impulse of each input, from rest in the steady motion.

    ``response[output, input]`` is one of them, shape (N,).

    Attributes:
        linear: the linear model.
        kind: ``"step"`` or ``"impulse"``.
        t: the instants, in s, shape (N,).
        values: the outputs, shape (N, number of outputs, number of inputs).
        inputs: the names of the inputs.
        outputs: the names of the outputs.

    >>> from symbody import step_response, equations_of, functions_of_time, linearize, time_derivative, Matrix
    >>> x, F = functions_of_time("x F")
    >>> linear = linearize(equations_of(Matrix([[1]]), [F - 4 * x - time_derivative(x)], [x]), outputs=[x])
    >>> step_response(linear, None, 20)
    TimeResponse(step; x to F; 1001 instants from 0 to 20 s)
    """

    linear: Linear = field(repr=False)
    kind: str
    t: Array
    values: Array
    inputs: tuple[Expr, ...]
    outputs: tuple[str, ...]

    def __getitem__(self, names: Any) -> Array:
        """Return the response of an output to an input, shape (N,)."""
        output, r = output_and_input("TimeResponse", names, self.outputs, self.inputs)
        return np.asarray(self.values[:, output, r])

    def __repr__(self) -> str:
        return (
            f"TimeResponse({self.kind}; {', '.join(self.outputs)} to {', '.join(map(str, self.inputs))}; "
            f"{counted(len(self.t), 'instant')} from {self.t[0]:g} to {self.t[-1]:g} s)"
        )

    def _repr_html_(self) -> str:
        rows = [
            [name, str(r), *(f"{x:.6g}" for x in (column.min(), column.max(), column[-1]))]
            for name in self.outputs
            for r in self.inputs
            for column in [self[name, r]]
        ]
        return html_table(repr(self), ["output", "input", "least", "largest", "last"], rows)

    @with_known_names
    def plot(
        self,
        *,
        units: Mapping[Expr | str, str] | None = None,
        title: str = "",
        path: str | os.PathLike[str] | None = None,
    ) -> Figure:
        """Return the outputs over time, a panel for each, with a curve for each input.

        Args:
            units: the units of outputs and inputs, by name.
            title: the title.
            path: a file to write as well.
        """
        figure: Figure = drawing_function("plot_time_response")(self, units=units, title=title, path=path)
        return figure


@with_known_names
def step_response(linear: Linear, parameters: Mapping[Expr, ArrayLike] | None, t: ArrayLike) -> TimeResponse:
    """Return the outputs after each input has jumped by 1: ``y = C x + D``, ``x' = A x + B``, ``x(0) = 0``.

    Where rates of inputs act, as that of a road on a damper, or E is singular, this is the limit of ever faster steps.

    ``exp([[A, B], [0, 0]] t)`` has the integral of ``exp(A t) B`` in its right column [Van Loan 1978], exactly.

    Args:
        linear: the linear model, with inputs and outputs.
        parameters: a number for each parameter.
        t: the instants, in s, increasing from 0 or later; a pair such as (0, 10), or the last one alone, stands for
            1001 evenly spaced instants, as in `simulate`.

    Raises:
        ParameterError: a value is missing, has an unknown key, is not finite, or is not one number.
        ModelError: there are no inputs or no outputs, or an output follows the rate of an input at once.
        ArgumentError: the instants don't increase.

    >>> from symbody import Body, Force, System, functions_of_time, ground, linearize, newton_euler, symbols, translate
    >>> (x, F), m = functions_of_time("x F"), symbols("m")
    >>> cart = Body(translate(x, 0, 0), m)
    >>> load = Force(ground, F, 0, 0, at=cart.center_of_mass, on=cart)
    >>> linear = linearize(newton_euler(System([cart], [load], coordinates=[x])), outputs=[x])
    >>> step_response(linear, {m: 2}, [0, 1, 2])["x", F]
    array([0.  , 0.25, 1.  ])
    """
    return _response("step", linear, parameters, t)


@with_known_names
def impulse_response(
    linear: Linear, parameters: Mapping[Expr, ArrayLike] | None, t: ArrayLike
) -> TimeResponse:
    """Return the outputs after an impulse of 1 of each input: ``y = C exp(A t) B``, the rate of the step response.

    Args:
        linear: the linear model, with inputs and outputs.
        parameters: a number for each parameter.
        t: the instants, in s, increasing from 0 or later; a pair such as (0, 10), or the last one alone, stands for
            1001 evenly spaced instants, as in `simulate`.

    Raises:
        ParameterError: a value is missing, has an unknown key, is not finite, or is not one number.
        ModelError: there are no inputs or no outputs, or an output follows an input at once, so that its response holds
            an impulse.
        ArgumentError: the instants don't increase.

    >>> from symbody import Body, Force, System, functions_of_time, ground, linearize, newton_euler, symbols, translate
    >>> (x, F), m = functions_of_time("x F"), symbols("m")
    >>> cart = Body(translate(x, 0, 0), m)
    >>> load = Force(ground, F, 0, 0, at=cart.center_of_mass, on=cart)
    >>> linear = linearize(newton_euler(System([cart], [load], coordinates=[x])), outputs=[x])
    >>> impulse_response(linear, {m: 2}, [0, 1, 2])["x", F]
    array([0. , 0.5, 1. ])
    """
    return _response("impulse", linear, parameters, t)


def _response(
    kind: str, linear: Linear, parameters: Mapping[Expr, ArrayLike] | None, t: ArrayLike
) -> TimeResponse:
    where = f"{kind}_response"
    found = transfer(linear, parameters, where)
    instants, model = _instants(t, where), realization(found)
    n, k = model.B.shape
    sudden = model.D[1:] if kind == "step" else model.D
    impulsive = [name for i, name in enumerate(linear.outputs) if any(D[i].any() for D in sudden)]
    if impulsive:
        cause = "the rate of an input" if kind == "step" else "an input"
        way = "use frequency_response" if kind == "step" else "use step_response"
        raise ModelError(
            f"{where}: {', '.join(impulsive)} follows {cause} at once, so that its response contains an impulse; "
            f"expected outputs such as positions and speeds, or {way}"
        )
    if kind == "step":
        whole = np.block([[model.A, model.B], [np.zeros((k, n + k))]])
        start = np.vstack([np.zeros((n, k)), np.eye(k)])
        values = model.C @ _states(whole, start, instants)[:, :n] + model.D[0]
    else:
        values = model.C @ _states(model.A, model.B, instants)
    return TimeResponse(linear, kind, instants, values, found.inputs, linear.outputs)


def _states(A: Array, start: Array, t: Array) -> Array:
    """Return ``exp(A t) x_0`` at N instants, step by step: shape (N, n, number of columns)."""
    from scipy.linalg import expm  # noqa: PLC0415 - slow to load

    powers: dict[float, Array] = {}
    found = np.empty((len(t), *start.shape))
    x, last = start, 0.0
    steps = np.diff(t, prepend=0.0)
    uniform = float(np.median(steps[1:])) if len(steps) > 1 else 0.0
    for k, step in enumerate(steps.tolist()):
        # instants of numpy.linspace differ by steps that are the same up to rounding
        span = uniform if abs(step - uniform) <= 1e-12 * max(abs(t[-1]), abs(uniform)) else t[k] - last
        if span:
            if span not in powers:
                powers[span] = np.asarray(expm(A * span), np.float64)
            x = powers[span] @ x
        found[k], last = x, t[k]
    return found


def _instants(t: ArrayLike, where: str) -> Array:
    try:
        instants = np.asarray(t, dtype=np.float64)
        fault = row_fault(t, instants, increasing=True)
    except (TypeError, ValueError):
        instants, fault = np.empty(0), row_fault(t, None)
    is_span = instants.ndim == 0 and np.isfinite(instants) and instants > 0 and not isinstance(t, bool)
    if fault and not is_span:
        raise ArgumentError(
            f"{where}, t: {fault}; expected the first and the last instant in s, such as (0, 5), all instants, "
            "increasing from 0, or the last one"
        )
    if is_span:
        return np.linspace(0.0, float(instants), _INSTANTS)
    return np.linspace(instants[0], instants[1], _INSTANTS) if len(instants) == 2 else instants
