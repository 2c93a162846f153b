"""Compass plots: the phasors of the coordinates in a mode."""

from __future__ import annotations

import os
from collections.abc import Mapping
from numbers import Real
from typing import Protocol

import numpy as np
from matplotlib.figure import Figure
from matplotlib.projections.polar import PolarAxes

from symbody.errors import ViewError
from symbody.multibody import Variables
from symbody.symbolic import Expr
from symbody.symbolic.given.arguments import described
from symbody.view.figure import NotebookFigure, finished, symbol_of, with_unit
from symbody.view.overview import overview

__all__ = ["plot_mode"]


class _Linear(Protocol):
    @property
    def system(self) -> Variables: ...


class DrawableMode(Protocol):
    """The interface of modes that can be drawn; those of `symbody.modes` satisfy it."""

    @property
    def linear(self) -> _Linear:
        """The linear model, with its system."""
        ...

    @property
    def shape(self) -> Mapping[Expr, complex]:
        """The deviations of all coordinates."""
        ...

    @property
    def speeds(self) -> Mapping[Expr, complex]:
        """The deviations of all speeds."""
        ...

    @property
    def title(self) -> str:
        """The system and its frequency, in words."""
        ...


def plot_mode(
    mode: DrawableMode, *, least: float = 0.01, title: str = "", path: str | os.PathLike[str] | None = None
) -> Figure:
    """Return the phasors of the coordinates in a mode, one panel for each kind: lengths, angles.

    Of a mode that moves no coordinate, the phasors of the speeds are drawn.

    Args:
        mode: the mode.
        least: the modulus below which a phasor is left out, relative to the largest one of all kinds.
        title: the title.
        path: a file to write as well.

    Raises:
        ViewError: nothing moves.
        PictureError: the file can't be written.
    """
    if isinstance(least, bool) or not isinstance(least, Real):
        raise ViewError(f"Mode.plot, least: {described(least)}; expected a number, such as 0.01")
    coordinates, speeds = overview(mode.linear.system)
    groups, phasors = coordinates, mode.shape
    if not any(phasors.values()):
        groups, phasors = speeds, mode.speeds
    largest = max((abs(value) for value in phasors.values()), default=0.0)
    if not largest:
        raise ViewError(
            "Mode.plot: no coordinate and no speed moves in this mode, only states beside the mechanics; "
            "mode.participation has these"
        )
    kinds: dict[tuple[str, str], dict[Expr, complex]] = {}
    for group in groups:
        moved = {
            q: phasors[q] for q in group.expressions if q in phasors and abs(phasors[q]) >= least * largest
        }
        if moved:
            kinds.setdefault((group.kind, group.unit("s")), {}).update(moved)
    figure = NotebookFigure(figsize=(5.2 * len(kinds), 4.6), layout="constrained")
    for k, ((kind, unit), moved) in enumerate(kinds.items()):
        axes = figure.add_subplot(1, len(kinds), k + 1, projection="polar")
        assert isinstance(axes, PolarAxes)
        _compass(axes, moved)
        axes.set_title(with_unit(kind, unit), fontsize="medium")
    return finished(figure, title or mode.title, path)


def _compass(axes: PolarAxes, phasors: Mapping[Expr, complex]) -> None:
    largest = max(map(abs, phasors.values()))
    for k, (name, value) in enumerate(phasors.items()):
        angle, size = float(np.angle(value)), abs(value)
        color = f"C{k % 10}"
        axes.annotate(
            "",
            xy=(angle, size),
            xytext=(0, 0),
            arrowprops={"arrowstyle": "-|>", "color": color, "lw": 2, "shrinkA": 0, "shrinkB": 0},
        )
        degrees = round(float(np.degrees(angle)))  # an integer: there is no -0
        axes.plot([], [], color=color, lw=2, label=f"{symbol_of(name)}: {size:.3g}, {degrees}°")
    axes.set_ylim(0, 1.08 * largest)
    axes.set_rlabel_position(200)
    axes.tick_params(labelsize="small")
    axes.grid(visible=True, alpha=0.3)
    axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.07), ncols=2, frameon=False, fontsize="small")
