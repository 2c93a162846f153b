"""The energy that motions through singular positions lose, over the tolerance."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import matplotlib as mpl
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from .scan import MECHANISMS, METHODS, Loss


def write_plot(found: Sequence[Loss], path: Path) -> None:
    """Write the largest and the median loss of each mechanism, a picture for each method."""
    figure = Figure(figsize=(11.2, 4.6), layout="constrained")
    axes = figure.subplots(1, len(METHODS), sharey=True, squeeze=False)[0]
    for axis, method in zip(axes, METHODS, strict=True):
        _draw(axis, method, [loss for loss in found if loss.method == method])
    axes[0].set_ylabel("part of the energy lost in 10 s")
    handles, labels = axes[0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside lower center", ncols=4, fontsize="small", frameon=False)
    with mpl.rc_context({"svg.hashsalt": "symbody", "svg.fonttype": "path"}):
        figure.savefig(path, metadata={"Date": None}, dpi=150)


def _draw(axis: Axes, method: str, found: Sequence[Loss]) -> None:
    bound = {loss.rtol: 10 * loss.regular for loss in found}
    for rtol in bound:
        bound[rtol] = max(10 * loss.regular for loss in found if loss.rtol == rtol)
    axis.fill_between(
        list(bound), list(bound.values()), 1e-16, color="#dddddd", label="ten times a swinging bar's, at most"
    )
    for name, label in MECHANISMS.items():
        curve = [loss for loss in found if loss.name == name]
        if not curve:
            continue
        rtol = [loss.rtol for loss in curve]
        (line,) = axis.plot(rtol, [loss.largest for loss in curve], marker="o", markersize=3, label=label)
        axis.plot(rtol, [loss.median for loss in curve], ":", color=line.get_color())
    axis.set(xscale="log", yscale="log", xlabel="rtol", title=method, ylim=(1e-13, 1))
    axis.invert_xaxis()
    axis.grid(alpha=0.3)
