"""Plots of sweeps: eigenvalues over one parameter, and maps of stability over two."""

from __future__ import annotations

import os
from collections.abc import Mapping
from typing import Protocol

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import NDArray

from symbody.errors import ViewError
from symbody.symbolic import Expr
from symbody.view.figure import NotebookFigure, finished, symbol_of, with_unit
from symbody.view.plot_argument import checked_units

__all__ = ["plot_sweep"]

Array = NDArray[np.float64]
Units = Mapping[Expr | str, str]


class _Linear(Protocol):
    @property
    def name(self) -> str: ...


class DrawableSweep(Protocol):
    """The interface of sweeps that can be drawn; the result of `symbody.sweep` satisfies it."""

    @property
    def linear(self) -> _Linear: ...
    @property
    def parameters(self) -> Mapping[Expr, Array]: ...
    @property
    def eigenvalues(self) -> NDArray[np.complex128]: ...
    @property
    def growth(self) -> Array: ...
    @property
    def varying(self) -> tuple[Expr, ...]: ...


def plot_sweep(
    sweep: DrawableSweep,
    *,
    units: Units | None = None,
    title: str = "",
    path: str | os.PathLike[str] | None = None,
) -> Figure:
    """Return the eigenvalues over one parameter, or the largest real part over a grid of two.

    Args:
        sweep: the sweep.
        units: the units of the parameters.
        title: the title.
        path: a file to write as well.

    Raises:
        ViewError: the cases are neither those of one parameter nor those of a grid of two.
        PictureError: the file can't be written.
    """
    units = checked_units(units, "Sweep.plot")
    labels = [_label(name, units) for name in sweep.varying]
    if len(labels) == 1:
        figure = _over_one(sweep, labels[0])
    elif len(labels) == 2 and _is_grid(sweep):
        figure = _map(sweep, labels)
    else:
        listed = ", ".join(map(str, sweep.varying)) or "nothing"
        raise ViewError(
            f"plot_sweep: the cases vary {listed}; expected those of one parameter, or a grid of two: "
            "cases=grid({...})"
        )
    return finished(figure, title or sweep.linear.name, path)


def _label(name: Expr, units: Units) -> str:
    unit = units.get(name, units.get(str(name), ""))
    return with_unit(symbol_of(name), unit)


def _is_grid(sweep: DrawableSweep) -> bool:
    sizes = [len(np.unique(sweep.parameters[name])) for name in sweep.varying]
    pairs = np.unique(np.array([sweep.parameters[name] for name in sweep.varying]), axis=1)
    return bool(np.prod(sizes) == len(sweep.growth) == pairs.shape[1])


def _over_one(sweep: DrawableSweep, label: str) -> Figure:
    values = sweep.parameters[sweep.varying[0]]
    figure = NotebookFigure(figsize=(7.5, 6.0), layout="constrained")
    real, imaginary = figure.subplots(2, 1, sharex=True)
    real.plot(values, sweep.eigenvalues.real, ".", ms=3, color="C0")
    imaginary.plot(values, np.abs(sweep.eigenvalues.imag), ".", ms=3, color="C0")
    real.axhline(0, color="0.4", lw=0.8)
    real.set_ylabel("real part [1/s]")
    imaginary.set_ylabel("imaginary part [rad/s]")
    imaginary.set_xlabel(label)
    for axes in (real, imaginary):
        axes.grid(visible=True, alpha=0.3)
    return figure


def _map(sweep: DrawableSweep, labels: list[str]) -> Figure:
    """Draw the largest real part in colours, and the limit of stability as a line."""
    first, second = (sweep.parameters[name] for name in sweep.varying)
    x, y = np.unique(first), np.unique(second)
    growth = np.full((len(y), len(x)), np.nan)
    growth[np.searchsorted(y, second), np.searchsorted(x, first)] = sweep.growth
    limit = float(np.nanmax(np.abs(growth))) or 1.0
    figure = NotebookFigure(figsize=(7.5, 5.5), layout="constrained")
    axes = figure.subplots()
    colours = axes.pcolormesh(
        x, y, growth, cmap="RdBu_r", vmin=-limit, vmax=limit, shading="nearest", rasterized=True
    )
    # the cells are centred at the values: half of the outer ones would show what was not computed
    axes.set(xlim=(x[0], x[-1]), ylim=(y[0], y[-1]))
    label = "largest real part [1/s]"
    if np.nanmin(growth) < 0 < np.nanmax(growth):
        label += "; line: limit of stability"
        axes.contour(x, y, growth, levels=[0.0], colors="k", linewidths=1.5)
    figure.colorbar(colours, ax=axes, label=label)
    axes.set_xlabel(labels[0])
    axes.set_ylabel(labels[1])
    return figure
