"""Plots of studies: statistics over time, distributions of measures, and indices of sensitivity."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from symbody.view.figure import NotebookFigure, finished, with_unit

__all__ = ["plot_sobol_indices", "plot_study"]

Array = NDArray[np.float64]

_MANY = 2000
"""The number of cases above which points are drawn without contours, and small."""


def plot_study(
    t: Array,
    name: str,
    *,
    bands: Mapping[str, Array] | None,
    values: Array | None,
    column: tuple[str, Array] | None,
    units: Mapping[str, str],
    title: str = "",
    path: str | os.PathLike[str] | None = None,
) -> Figure:
    """Return a figure of an output over time, or of a measure.

    Args:
        t: the instants, in s.
        name: the name of the output or the measure.
        bands: the statistics of the output at the instants, by name.
        values: the measure of all cases.
        column: the variable over which the measure is drawn, and its values, in place of the distribution.
        units: the units, by name.
        title: the title.
        path: a file to write as well.

    Raises:
        PictureError: the file can't be written.
    """
    figure = NotebookFigure(figsize=(7.5, 4.5), layout="constrained")
    axes = figure.subplots()
    label = with_unit(name, units.get(name, "s" if name.endswith(" instant") else ""))
    if bands is not None:
        _over_time(axes, t, bands)
        axes.set(xlabel="t [s]", ylabel=label, xlim=(t[0], t[-1]))
    elif values is not None and column is not None:
        other, given = column
        size, alpha = (2.0, 0.4) if len(values) > _MANY else (9.0, 0.6)
        axes.scatter(given, values, s=size, alpha=alpha, linewidths=0, rasterized=len(values) > _MANY)
        axes.set(xlabel=with_unit(other, units.get(other, "")), ylabel=label)
    elif values is not None:
        _distribution(axes, values)
        axes.set(xlabel=label, ylabel="probability density")
    axes.grid(visible=True, alpha=0.3)
    return finished(figure, title, path)


def _over_time(axes: Axes, t: Array, bands: Mapping[str, Array]) -> None:
    """Draw the extremes and pairs of quantiles as bands, and the mean and single quantiles as lines."""
    if "minimum" in bands:
        axes.fill_between(t, bands["minimum"], bands["maximum"], color="0.9", lw=0, label="extremes")
    levels = sorted(float(name.removeprefix("quantile ")) for name in bands if name.startswith("quantile "))
    paired = [p for p in levels if p < 0.5 and any(abs(1 - p - q) < 1e-12 for q in levels)]
    for k, p in enumerate(paired):
        upper = next(q for q in levels if abs(1 - p - q) < 1e-12)
        low, high = bands[f"quantile {p:g}"], bands[f"quantile {upper:g}"]
        text = f"{100 * p:g} % to {100 * upper:g} %"
        axes.fill_between(t, low, high, color="C0", alpha=0.2 + 0.15 * k, lw=0, label=text)
    if "mean" in bands:
        axes.plot(t, bands["mean"], color="C0", label="mean")
    for k, p in enumerate(
        q for q in levels if q not in paired and not any(abs(1 - q - r) < 1e-12 for r in paired)
    ):
        axes.plot(
            t,
            bands[f"quantile {p:g}"],
            color=f"C{k + 1}",
            lw=1,
            label="median" if p == 0.5 else f"{100 * p:g} %",
        )
    axes.legend(loc="best", fontsize="small")


def _distribution(axes: Axes, values: Array) -> None:
    """Draw a histogram, the mean, and the quantiles 5 % and 95 %."""
    known = values[np.isfinite(values)]
    if not known.size:
        axes.text(0.5, 0.5, "no case has a value", ha="center", transform=axes.transAxes)
        return
    edges = np.histogram_bin_edges(known, bins=int(np.clip(np.sqrt(known.size), 10, 80)))
    axes.hist(known, bins=edges.tolist(), density=True, color="C0", alpha=0.6)
    axes.axvline(known.mean(), color="C1", label="mean")
    for place, p in enumerate((0.05, 0.95)):
        label = "5 % and 95 %" if place == 0 else None
        axes.axvline(np.quantile(known, p), color="C1", ls="--", lw=1, label=label)
    axes.legend(loc="best", fontsize="small")


def plot_sobol_indices(
    names: Sequence[str],
    first: Array,
    total: Array,
    first_interval: Array,
    total_interval: Array,
    *,
    title: str = "",
    path: str | os.PathLike[str] | None = None,
) -> Figure:
    """Return the first-order and the total index of each variable, with confidence intervals.

    Args:
        names: the variables.
        first: the first-order indices.
        total: the total indices.
        first_interval: the confidence intervals of the first, shape (d, 2).
        total_interval: those of the others.
        title: the title.
        path: a file to write as well.

    Raises:
        PictureError: the file can't be written.
    """
    figure = NotebookFigure(figsize=(max(5.0, 0.9 * len(names) + 2.5), 4.0), layout="constrained")
    axes, places = figure.subplots(), np.arange(len(names))
    rows = (("first order", first, first_interval, -0.2), ("total", total, total_interval, 0.2))
    for label, values, interval, shift in rows:
        error = np.maximum(0.0, np.array([values - interval[:, 0], interval[:, 1] - values]))
        axes.bar(places + shift, values, 0.38, yerr=error, capsize=3, label=label)
    axes.set_xticks(places, names)
    axes.set_ylabel("share of the variance")
    axes.axhline(0, color="0.4", lw=0.8)
    axes.grid(visible=True, axis="y", alpha=0.3)
    axes.legend(loc="best", fontsize="small")
    return finished(figure, title, path)
