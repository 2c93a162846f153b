"""Frequency responses of linear models: Bode and Nyquist."""

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
from symbody.symbolic.given.arguments import brief, counted, with_known_names

from .output_and_input import output_and_input
from .row_fault import row_fault
from .transfer import Transfer, transfer

if TYPE_CHECKING:
    from matplotlib.figure import Figure

__all__ = ["FrequencyResponse", "frequency_response"]

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]

_WHERE = "frequency_response"
_RESONANT = 1e-14
"""The distance, relative to the largest eigenvalue, up to which a frequency is an eigenvalue."""


@dataclass(frozen=True, eq=False)
class FrequencyResponse:
    """The complex amplitudes of outputs for inputs ``r = exp(i omega t)``.

    ``response[output, input]`` is one of them, shape (N,).

    Attributes:
        linear: the linear model.
        omega: the frequencies, in rad/s, shape (N,).
        values: H(i omega), shape (N, number of outputs, number of inputs).
        inputs: the names of the inputs.
        outputs: the names of the outputs.

    >>> from symbody import frequency_response, equations_of, functions_of_time, linearize, time_derivative, Matrix
    >>> x, F = functions_of_time("x F")
    >>> linear = linearize(equations_of(Matrix([[1]]), [F - 4 * x - time_derivative(x)], [x]), outputs=[x])
    >>> frequency_response(linear, None, [0, 2]).magnitude[:, 0, 0]
    array([0.25, 0.5 ])
    """

    linear: Linear = field(repr=False)
    omega: Array
    values: Complex
    inputs: tuple[Expr, ...]
    outputs: tuple[str, ...]

    def __getitem__(self, names: Any) -> Complex:
        """Return the response of an output to an input, shape (N,)."""
        output, r = output_and_input("FrequencyResponse", names, self.outputs, self.inputs)
        return np.asarray(self.values[:, output, r])

    @property
    def magnitude(self) -> Array:
        """|H|, shape (N, number of outputs, number of inputs)."""
        return np.abs(self.values)

    @property
    def phase(self) -> Array:
        """The phase of H in rad, continuous over the frequency, shape (N, number of outputs, number of inputs)."""
        return np.unwrap(np.angle(self.values), axis=0)

    def __repr__(self) -> str:
        return (
            f"FrequencyResponse({', '.join(self.outputs)} to {', '.join(map(str, self.inputs))}; "
            f"{counted(len(self.omega), 'frequency')} from {self.omega[0]:.6g} to {self.omega[-1]:.6g} rad/s)"
        )

    def _repr_html_(self) -> str:
        peaks = np.argmax(self.magnitude, axis=0)
        rows = [
            [name, str(r), f"{self.magnitude[peaks[i, j], i, j]:.6g}", f"{self.omega[peaks[i, j]]:.6g}"]
            for i, name in enumerate(self.outputs)
            for j, r in enumerate(self.inputs)
        ]
        return html_table(repr(self), ["output", "input", "largest |H|", "at [rad/s]"], rows)

    @with_known_names
    def plot(
        self,
        kind: str = "bode",
        *,
        units: Mapping[Expr | str, str] | None = None,
        title: str = "",
        path: str | os.PathLike[str] | None = None,
    ) -> Figure:
        """Return a Bode plot, magnitude and phase over the frequency, or a Nyquist plot in the complex plane.

        Args:
            kind: ``"bode"`` or ``"nyquist"``.
            units: the units of outputs and inputs, by name.
            title: the title.
            path: a file to write as well.
        """
        figure: Figure = drawing_function("plot_frequency_response")(
            self, kind, units=units, title=title, path=path
        )
        return figure


@with_known_names
def frequency_response(
    linear: Linear, parameters: Mapping[Expr, ArrayLike] | None, omega: ArrayLike
) -> FrequencyResponse:
    """Return ``H(s) = (C0 + s C1) (s E - A0)^-1 B0 + D0`` at ``s = i omega``.

    It is the ratio of the complex amplitudes in the steady state, which the motion reaches if all modes decay; if one
    grows, a notice says so. Rates of inputs that are inputs as well are taken for ``i omega`` times the input.

    Args:
        linear: the linear model, with inputs and outputs.
        parameters: a number for each parameter.
        omega: the frequencies, in rad/s.

    Raises:
        ParameterError: a value is missing, has an unknown key, is not finite, or is not one number.
        ModelError: there are no inputs or no outputs, or a frequency is an eigenvalue: the response is infinite.

    >>> from symbody import Body, Force, System, functions_of_time, ground, linearize, newton_euler, symbols, translate
    >>> from symbody import time_derivative
    >>> (x, F), (m, k, c) = functions_of_time("x F"), symbols("m k c")
    >>> cart = Body(translate(x, 0, 0), m)
    >>> load = Force(ground, F - k * x - c * time_derivative(x), 0, 0, at=cart.center_of_mass, on=cart)
    >>> linear = linearize(newton_euler(System([cart], [load], coordinates=[x])), outputs=[x])
    >>> response = frequency_response(linear, {m: 1, k: 100, c: 2}, [0, 10])
    >>> response["x", F].round(6)
    array([0.01+0.j  , 0.  -0.05j])
    """
    found = transfer(linear, parameters, _WHERE)
    try:
        frequencies = np.atleast_1d(np.asarray(omega, dtype=np.float64))
        fault = row_fault(omega, frequencies)
    except (TypeError, ValueError):
        frequencies, fault = np.empty(0), row_fault(omega, None)
    if fault:
        raise ArgumentError(
            f"{_WHERE}, omega: {fault}; expected a row of finite frequencies in rad/s, such as "
            "numpy.geomspace(0.1, 100, 500)"
        )
    values = _values(found, frequencies)
    found.warn_if_unstable(_WHERE, "its motions don't reach the steady state that this response describes")
    return FrequencyResponse(linear, frequencies, values, found.inputs, linear.outputs)


def _values(found: Transfer, omega: Array) -> Complex:
    """Return H(i omega), shape (N, number of outputs, number of inputs).

    Raises:
        ModelError: a frequency is an eigenvalue.
    """
    m, s = found.matrices, 1j * omega[:, None, None]
    powers = np.zeros((len(omega), len(found.linear.inputs), len(found.inputs)), dtype=np.complex128)
    for k, (place, order) in enumerate(found.orders):
        powers[:, k, place] = (1j * omega) ** order
    shifted = s * m.E - m.A0
    try:
        states = np.linalg.solve(
            shifted, np.broadcast_to(m.B0 @ powers, (*shifted.shape[:2], len(found.inputs)))
        )
        values = (m.C0 + s * m.C1) @ states + m.D0 @ powers
    except np.linalg.LinAlgError:
        values = np.full((len(omega), 1, 1), np.inf + 0j)
        singular = np.linalg.svd(shifted, compute_uv=False)
        values[singular[:, -1] > 0] = 0
    eigenvalues = found.eigenvalues
    near = np.abs(1j * omega[:, None] - eigenvalues).min(axis=1, initial=np.inf)
    resonant = near <= _RESONANT * np.abs(eigenvalues).max(initial=0.0)
    infinite = ~np.isfinite(values).all(axis=(1, 2)) | resonant
    if infinite.any():
        at = omega[np.argmax(infinite)]
        advice = (
            f"{brief(', '.join(map(str, found.linear.ignorable)))} can be left out: keep_ignorable=False"
            if at == 0 and found.linear.ignorable
            else "leave this frequency out, or add damping"
        )
        value = f"{at:.6g}i" if at else "0"
        raise ModelError(
            f"{_WHERE}: the response is infinite at omega = {at:.6g} rad/s: {value} is an eigenvalue; {advice}"
        )
    return np.asarray(values)
