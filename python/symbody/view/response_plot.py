"""Plots of responses of linear models: Bode and Nyquist plots, step and impulse responses."""

from __future__ import annotations

import os
from collections.abc import Mapping
from typing import Protocol

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from symbody.errors import ViewError
from symbody.multibody import Variables
from symbody.symbolic import Expr
from symbody.symbolic.given.arguments import described
from symbody.view.figure import NotebookFigure, finished, symbol_of, with_unit
from symbody.view.overview import overview
from symbody.view.plot_argument import checked_units

__all__ = ["plot_frequency_response", "plot_time_response"]

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]
Units = Mapping[Expr | str, str]


class _Linear(Protocol):
    @property
    def name(self) -> str: ...
    @property
    def system(self) -> Variables: ...


class DrawableFrequencyResponse(Protocol):
    """The interface of frequency responses; the result of `symbody.frequency_response` satisfies it."""

    @property
    def linear(self) -> _Linear: ...
    @property
    def omega(self) -> Array: ...
    @property
    def values(self) -> Complex: ...
    @property
    def phase(self) -> Array: ...
    @property
    def inputs(self) -> tuple[Expr, ...]: ...
    @property
    def outputs(self) -> tuple[str, ...]: ...


class DrawableTimeResponse(Protocol):
    """The interface of step and impulse responses; those of `symbody` satisfy it."""

    @property
    def linear(self) -> _Linear: ...
    @property
    def kind(self) -> str: ...
    @property
    def t(self) -> Array: ...
    @property
    def values(self) -> Array: ...
    @property
    def inputs(self) -> tuple[Expr, ...]: ...
    @property
    def outputs(self) -> tuple[str, ...]: ...


def plot_frequency_response(
    response: DrawableFrequencyResponse,
    kind: str = "bode",
    *,
    units: Units | None = None,
    title: str = "",
    path: str | os.PathLike[str] | None = None,
) -> Figure:
    """Return a Bode or a Nyquist plot, a column for each input, a curve for each output.

    Args:
        response: the frequency response.
        kind: ``"bode"`` or ``"nyquist"``.
        units: the units of outputs and inputs, by name.
        title: the title.
        path: a file to write as well.

    Raises:
        ViewError: the kind is not known.
        PictureError: the file can't be written.
    """
    if kind not in ("bode", "nyquist"):
        raise ViewError(f"FrequencyResponse.plot, kind: {described(kind)}; expected 'bode' or 'nyquist'")
    where = f"{type(response).__name__}.plot"
    names = _labels(response.linear.system, response.inputs, response.outputs, checked_units(units, where))
    columns, rows = len(response.inputs), 2 if kind == "bode" else 1
    figure = NotebookFigure(figsize=(6.0 * columns + 1.5, 2.8 * rows + 1.4), layout="constrained")
    grid = figure.subplots(rows, columns, squeeze=False, sharex="col" if kind == "bode" else False)
    for j, r in enumerate(response.inputs):
        if kind == "bode":
            _bode(grid[0, j], grid[1, j], response, names, j)
        else:
            _nyquist(grid[0, j], response, names, j)
        grid[0, j].set_title(f"input {names[r]}", fontsize="medium")
    grid[0, -1].legend(loc="upper left", bbox_to_anchor=(1, 1), frameon=False, title="output")
    return finished(figure, title or response.linear.name, path)


def _bode(
    magnitude: Axes, phase: Axes, response: DrawableFrequencyResponse, names: Mapping[Expr | str, str], j: int
) -> None:
    """Draw magnitude and phase over the frequency.

    Args:
        magnitude: the upper axes.
        phase: the lower axes.
        response: the response.
        names: the names of inputs and outputs, with units.
        j: the input.
    """
    for i, output in enumerate(response.outputs):
        magnitude.loglog(response.omega, np.abs(response.values[:, i, j]), label=names[output])
        phase.semilogx(response.omega, np.degrees(response.phase[:, i, j]))
    magnitude.set_ylabel("amplitude of output per input")
    phase.set_ylabel("phase [degrees]")
    phase.set_xlabel("frequency [rad/s]")
    for axes in (magnitude, phase):
        axes.grid(visible=True, which="both", alpha=0.3)
        axes.margins(x=0)


def _nyquist(
    axes: Axes, response: DrawableFrequencyResponse, names: Mapping[Expr | str, str], j: int
) -> None:
    """Draw the responses in the complex plane; negative frequencies are dashed, and -1 is a cross.

    Args:
        axes: the axes.
        response: the response.
        names: the names of inputs and outputs, with units.
        j: the input.
    """
    for i, output in enumerate(response.outputs):
        values = response.values[:, i, j]
        (line,) = axes.plot(values.real, values.imag, label=names[output])
        axes.plot(values.real, -values.imag, "--", lw=1, color=line.get_color())
    axes.plot(-1, 0, "k+", ms=9)
    axes.axvline(0, color="0.4", lw=0.8)
    axes.axhline(0, color="0.4", lw=0.8)
    axes.set_xlabel("real part of output per input")
    axes.set_ylabel("imaginary part of output per input")
    axes.grid(visible=True, alpha=0.3)


def plot_time_response(
    response: DrawableTimeResponse,
    *,
    units: Units | None = None,
    title: str = "",
    path: str | os.PathLike[str] | None = None,
) -> Figure:
    """Return the outputs over time, a panel for each, with a curve for each input.

    Args:
        response: the step or impulse response.
        units: the units of outputs and inputs, by name.
        title: the title.
        path: a file to write as well.

    Raises:
        PictureError: the file can't be written.
    """
    where = f"{type(response).__name__}.plot"
    names = _labels(response.linear.system, response.inputs, response.outputs, checked_units(units, where))
    rows = len(response.outputs)
    figure = NotebookFigure(figsize=(7.5, 2.4 * rows + 0.8), layout="constrained")
    grid = figure.subplots(rows, 1, sharex=True, squeeze=False)[:, 0]
    for i, output in enumerate(response.outputs):
        for j, r in enumerate(response.inputs):
            grid[i].plot(response.t, response.values[:, i, j], label=names[r])
        grid[i].set_ylabel(names[output])
        grid[i].grid(visible=True, alpha=0.3)
        grid[i].margins(x=0)
    grid[0].legend(loc="upper left", bbox_to_anchor=(1, 1), frameon=False, title=f"{response.kind} of")
    grid[-1].set_xlabel("time [s]")
    return finished(figure, title or response.linear.name, path)


def _labels(
    system: Variables, inputs: tuple[Expr, ...], outputs: tuple[str, ...], units: Units
) -> dict[Expr | str, str]:
    """Return inputs and outputs in mathematical type, with their units as far as these are known.

    Args:
        system: the system.
        inputs: the inputs.
        outputs: the names of the outputs.
        units: those given.
    """
    usual = {
        str(x): (symbol_of(x), group.unit("s"))
        for part in overview(system)
        for group in part
        for x in group.expressions
    }
    given = {str(name): unit for name, unit in units.items()}
    found: dict[Expr | str, str] = {}
    every: list[Expr | str] = [*inputs, *outputs]
    for name in every:
        shown, unit = usual.get(str(name), (symbol_of(name) if isinstance(name, Expr) else name, ""))
        unit = given.get(str(name), unit)
        found[name] = with_unit(shown, unit)
    return found
