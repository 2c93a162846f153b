"""Plots of fits: measured values, fitted motions, and residuals."""

from __future__ import annotations

import os
from collections.abc import Sequence

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import NDArray

from symbody.symbolic import Expr
from symbody.view.figure import NotebookFigure, finished, symbol_of

__all__ = ["plot_fit"]

Array = NDArray[np.float64]


def plot_fit(
    t: Array,
    rows: Sequence[tuple[Expr, Array, Array, Array, Array]],
    *,
    is_relative: bool,
    title: str = "",
    path: str | os.PathLike[str] | None = None,
) -> Figure:
    """Return a figure with two plots for each measurement: values with the motion, and residuals.

    Args:
        t: the instants of the motion, in s.
        rows: for each measurement its expression, its instants, its values, the motion, and the residuals.
        is_relative: whether the residuals are relative to the deviations of the measurements.
        title: the title.
        path: a file to write as well.

    Raises:
        PictureError: the file can't be written.
    """
    figure = NotebookFigure(figsize=(7.5, 1.0 + 3.2 * len(rows)), layout="constrained")
    heights = [part for _ in rows for part in (3, 1)]
    axes = np.atleast_1d(figure.subplots(2 * len(rows), 1, sharex=True, height_ratios=heights))
    for k, (expression, instants, values, along, residuals) in enumerate(rows):
        above, below = axes[2 * k], axes[2 * k + 1]
        above.plot(instants, values, ".", ms=4, color="0.5", label="measured")
        above.plot(t, along, color="C0", label="fitted")
        above.set_ylabel(symbol_of(expression))
        above.legend(loc="best", fontsize="small")
        below.plot(instants, residuals, ".", ms=3, color="C1")
        below.axhline(0, color="0.4", lw=0.8)
        below.set_ylabel("residual /\ndeviation" if is_relative else "residual", fontsize="small")
    for each in axes:
        each.grid(visible=True, alpha=0.3)
    axes[-1].set_xlabel("t [s]")
    figure.align_ylabels()
    return finished(figure, title, path)
