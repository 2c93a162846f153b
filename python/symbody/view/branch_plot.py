"""Plots of branches: expressions of steady motions over the parameter of a branch."""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import NDArray

from symbody.multibody import Variables
from symbody.symbolic import Expr
from symbody.view.figure import finished, symbol_of, with_unit
from symbody.view.overview import overview
from symbody.view.plot import Units, figure_over
from symbody.view.plot_argument import checked_units

__all__ = ["plot_branch"]


class DrawableBranch(Protocol):
    """The interface of branches that can be drawn; the result of `symbody.continuation` satisfies it."""

    @property
    def parameter(self) -> Expr:
        """The parameter."""
        ...

    @property
    def system(self) -> Variables:
        """The system that moves."""
        ...

    @property
    def varying(self) -> tuple[Expr, ...]:
        """The variables that are drawn by default."""
        ...

    @property
    def marks(self) -> dict[str, list[int]]:
        """The places of folds and branch points, by name."""
        ...

    def evaluate(self, expressions: Sequence[Expr]) -> NDArray[np.float64]:
        """Return the values of several expressions, one row for each."""
        ...


@dataclass(frozen=True, eq=False)
class _Over:
    """A branch as a motion, whose instants are the values of its parameter."""

    branch: DrawableBranch
    t: NDArray[np.float64]

    @property
    def system(self) -> Variables:
        return self.branch.system

    def evaluate(self, expressions: Sequence[Expr]) -> NDArray[np.float64]:
        return self.branch.evaluate(expressions)

    def __getitem__(self, expression: Expr) -> NDArray[np.float64]:
        return np.asarray(self.evaluate([expression])[0])


MARKERS = {"fold": "o", "branch point": "x"}


def plot_branch(
    branch: DrawableBranch,
    *panels: Any,
    units: Units | None = None,
    title: str = "",
    path: str | os.PathLike[str] | None = None,
) -> Figure:
    """Return a figure of expressions over the parameter of a branch, one panel for each argument.

    Folds are marked by dots, and points where branches cross by crosses.

    Args:
        branch: the branch.
        panels: an expression, a list of expressions that share a panel, or a dictionary of them by name; by default,
            a panel for each variable that varies.
        units: the units of expressions, of names of curves, and of the parameter.
        title: the title.
        path: a file to write as well, as in `plot`.

    Raises:
        ViewError: a panel is not an expression, or a value is not finite.
        PictureError: the file can't be written.

    >>> from symbody import continuation, newton_euler, steady
    >>> from symbody.models import single_track_car
    >>> car = single_track_car()
    >>> found = steady(newton_euler(car.system), car.parameters, inputs=car.inputs)
    >>> figure = plot_branch(continuation(found, car["u"], (5, 40)), car["r"], units={car["u"]: "m/s"})
    >>> figure.axes[0].get_xlabel(), figure.axes[0].get_ylabel()
    ('$u$ [m/s]', '$r$ [rad/s]')
    """
    shown = panels or branch.varying
    values = branch.evaluate([branch.parameter])[0]
    kinds = (group for part in overview(branch.system) for group in part)
    usual = next((group.unit("s") for group in kinds if branch.parameter in group.expressions), "")
    units = checked_units(units, "Branch.plot")
    unit = units.get(branch.parameter, usual)
    name = symbol_of(branch.parameter)
    figure = figure_over(_Over(branch, values), with_unit(name, unit), shown, units, "s")
    for axes in figure.axes:
        axes.margins(x=0.02)
        for line in [*axes.get_lines()]:
            x, y = (np.asarray(values, dtype=float) for values in line.get_data())
            for mark, places in branch.marks.items():
                (dots,) = axes.plot(x[places], y[places], MARKERS[mark], color=line.get_color(), zorder=3)
                dots.set(clip_on=False, in_layout=False)
    return finished(figure, title or branch.system.name, path)
