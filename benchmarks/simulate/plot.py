"""The work-precision plot: what each contender takes against what it misses."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import zip_longest
from pathlib import Path

import matplotlib as mpl
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from . import by_symbody
from .precision import Comparison, Curve

COLOURS = {
    "dop853": "#0b5394",
    "tsit5": "#1c9a8d",
    "bdf": "#6a3d9a",
    "esdirk34": "#b15928",
    "ida": "#555555",
    "RK45": "#1c9a8d",
    "DOP853": "#0b5394",
    "LSODA": "#d62728",
    "Radau": "#b15928",
    "BDF": "#6a3d9a",
}
"""Methods of the same kind have the same colour in both tools."""


def write_plot(comparisons: Sequence[Comparison], path: Path) -> None:
    """Write the curves of the problems side by side, the same for the same measurements."""
    figure = Figure(figsize=(5.6 * len(comparisons), 4.6), layout="constrained")
    axes = figure.subplots(1, len(comparisons), sharey=True, squeeze=False)[0]
    for axis, comparison in zip(axes, comparisons, strict=True):
        _draw(axis, comparison)
    axes[0].set_ylabel("processor time of one integration [s]")
    curves = _in_rows([curve for comparison in comparisons for curve in comparison.curves])
    figure.legend(
        handles=[_line(curve, label=curve.contender.label) for curve in curves],
        loc="outside lower center",
        ncols=5,
        handlelength=3.5,
        fontsize="small",
        frameon=False,
    )
    with mpl.rc_context({"svg.hashsalt": "symbody", "svg.fonttype": "path"}):
        figure.savefig(path, metadata={"Date": None} if path.suffix == ".svg" else None, dpi=150)


def _in_rows(curves: Sequence[Curve]) -> list[Curve]:
    """Return a curve of each contender, the tools in turns: a legend fills its columns first."""
    named = {curve.contender.label: curve for curve in curves}.values()
    own = [curve for curve in named if curve.contender.tool == by_symbody.TOOL]
    others = [curve for curve in named if curve.contender.tool != by_symbody.TOOL]
    return [curve for pair in zip_longest(own, others) for curve in pair if curve is not None]


def _draw(axis: Axes, comparison: Comparison) -> None:
    for curve in comparison.curves:
        axis.add_line(_line(curve))
    axis.set(
        xscale="log", yscale="log", title=_title(comparison), xlabel="largest error of a coordinate [rad]"
    )
    axis.autoscale_view()
    axis.set_xlim(2e-1, 5e-14)
    axis.grid(which="major", color="#dddddd", linewidth=0.6)


def _line(curve: Curve, label: str | None = None) -> mpl.lines.Line2D:
    is_own = curve.contender.tool == by_symbody.TOOL
    return mpl.lines.Line2D(
        [point.error for point in curve.points],
        [point.seconds for point in curve.points],
        color=COLOURS[curve.contender.method],
        linestyle="-" if is_own else "--",
        marker="o" if is_own else "s",
        markersize=4,
        markerfacecolor=COLOURS[curve.contender.method] if is_own else "white",
        label=label,
    )


def _title(comparison: Comparison) -> str:
    return f"{comparison.problem.name}, {comparison.problem.duration:g} s"
