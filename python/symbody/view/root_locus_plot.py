"""Plots of root loci: in the complex plane, and over the parameter."""

from __future__ import annotations

import os
from collections.abc import Sequence
from typing import Protocol

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from symbody.errors import ViewError
from symbody.symbolic import Expr
from symbody.symbolic.given.arguments import described
from symbody.view.figure import NotebookFigure, finished, symbol_of, with_unit
from symbody.view.plot_argument import checked_limits

__all__ = ["plot_root_locus"]

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]

_KINDS = ("both", "plane", "over")


class _Critical(Protocol):
    @property
    def value(self) -> float: ...
    @property
    def eigenvalue(self) -> complex: ...
    @property
    def branch(self) -> int: ...


class _Linear(Protocol):
    @property
    def name(self) -> str: ...


class DrawableLocus(Protocol):
    """The interface of root loci that can be drawn; the result of `symbody.root_locus` satisfies it."""

    @property
    def linear(self) -> _Linear:
        """The linear model, with its name."""
        ...

    @property
    def parameter(self) -> Expr:
        """The parameter."""
        ...

    @property
    def values(self) -> Array:
        """The values of the parameter, (N,)."""
        ...

    @property
    def eigenvalues(self) -> Complex:
        """The branches, (N, n)."""
        ...

    @property
    def names(self) -> tuple[str, ...]:
        """The name of each branch."""
        ...

    @property
    def critical(self) -> Sequence[_Critical]:
        """The critical values."""
        ...


def plot_root_locus(
    locus: DrawableLocus,
    kind: str = "both",
    *,
    unit: str = "",
    real: tuple[float, float] | None = None,
    imaginary: tuple[float, float] | None = None,
    title: str = "",
    path: str | os.PathLike[str] | None = None,
) -> Figure:
    """Return a root locus in the complex plane, and its real and imaginary parts over the parameter.

    In the plane, a cross is the first value of the parameter and a dot the last one; black circles are critical values.

    Args:
        locus: the root locus.
        kind: ``"both"``, ``"plane"`` or ``"over"``.
        unit: the unit of the parameter.
        real: the limits of real parts; by default, all are shown.
        imaginary: the limits of imaginary parts.
        title: the title.
        path: a file to write as well.

    Raises:
        ViewError: the kind is not known.
        PictureError: the file can't be written.
    """
    if kind not in _KINDS:
        raise ViewError(f"RootLocus.plot, kind: {described(kind)}; expected 'both', 'plane' or 'over'")
    real, imaginary = (
        checked_limits(given, f"RootLocus.plot, {name}")
        for name, given in (("real", real), ("imaginary", imaginary))
    )
    columns = 2 if kind == "both" else 1
    figure = NotebookFigure(figsize=(6.5 * columns + 1, 6.0), layout="constrained")
    grid = figure.add_gridspec(2, columns)
    name = symbol_of(locus.parameter)
    label = with_unit(name, unit)
    if kind != "over":
        plane = figure.add_subplot(grid[:, 0])
        _plane(plane, locus, name, unit)
        plane.set(xlim=real, ylim=imaginary)
        if kind == "plane":
            plane.legend(loc="upper left", bbox_to_anchor=(1, 1), frameon=False)
    if kind != "plane":
        upper = figure.add_subplot(grid[0, -1])
        lower = figure.add_subplot(grid[1, -1], sharex=upper)
        _over(upper, lower, locus)
        upper.set_ylim(real)
        lower.set_ylim(None if imaginary is None else (min(0.0, *imaginary) * 0.02, max(imaginary)))
        lower.set_xlabel(label)
        upper.tick_params(labelbottom=False)
    return finished(figure, title or locus.linear.name, path)


def _colors(locus: DrawableLocus) -> dict[str, str]:
    return {name: f"C{k % 10}" for k, name in enumerate(dict.fromkeys(locus.names))}


def _plane(axes: Axes, locus: DrawableLocus, name: str, unit: str) -> None:
    """Draw the locus in the complex plane."""
    colors, labelled = _colors(locus), set[str]()
    for branch, each in zip(locus.eigenvalues.T, locus.names, strict=True):
        axes.plot(branch.real, branch.imag, color=colors[each], label=None if each in labelled else each)
        axes.plot(branch.real[0], branch.imag[0], "x", color=colors[each])
        axes.plot(branch.real[-1], branch.imag[-1], ".", ms=9, color=colors[each])
        labelled.add(each)
    for critical in locus.critical:
        s = critical.eigenvalue
        for imaginary in {s.imag, -s.imag}:
            axes.plot(0, imaginary, "o", mfc="none", color="k", zorder=3)
    axes.axvline(0, color="0.4", lw=0.8)
    axes.axhline(0, color="0.4", lw=0.8)
    axes.set_xlabel("real part [1/s]")
    axes.set_ylabel("imaginary part [rad/s]")
    low, high = (f"{locus.values[k]:.4g}" for k in (0, -1))
    axes.set_title(f"× {name} = {low} {unit}, • {name} = {high} {unit}".replace(" ,", ","), fontsize="medium")
    axes.grid(visible=True, alpha=0.3)


def _over(real: Axes, imaginary: Axes, locus: DrawableLocus) -> None:
    """Draw real and imaginary parts over the parameter; the lower half of each pair is left out."""
    colors, labelled = _colors(locus), set[str]()
    scale = float(np.abs(locus.eigenvalues).max(initial=0.0))
    for branch, each in zip(locus.eigenvalues.T, locus.names, strict=True):
        color = colors[each]
        real.plot(locus.values, branch.real, color=color, label=None if each in labelled else each)
        above = np.where(branch.imag >= -1e-12 * scale, branch.imag, np.nan)
        imaginary.plot(locus.values, above, color=color)
        labelled.add(each)
    last = locus.values[0] + 0.88 * np.ptp(locus.values)
    for critical in locus.critical:
        color = colors[locus.names[critical.branch]]
        is_last = critical.value > last
        for axes, value in ((real, 0.0), (imaginary, critical.eigenvalue.imag)):
            axes.axvline(critical.value, color=color, lw=0.8, ls=":")
            axes.plot(critical.value, value, "o", mfc="none", color="k", zorder=3)
        real.annotate(
            f"{critical.value if abs(critical.value) > 1e-12 * np.ptp(locus.values) else 0.0:.4g}",
            (critical.value, 0),
            xycoords=("data", "axes fraction"),
            xytext=(-3 if is_last else 3, 4),
            ha="right" if is_last else "left",
            textcoords="offset points",
            fontsize="small",
            color=color,
        )
    real.axhline(0, color="0.4", lw=0.8)
    real.set_ylabel("real part [1/s]")
    imaginary.set_ylabel("imaginary part [rad/s]")
    for axes in (real, imaginary):
        axes.grid(visible=True, alpha=0.3)
        axes.margins(x=0)
    real.legend(loc="upper left", bbox_to_anchor=(1, 1), frameon=False)
