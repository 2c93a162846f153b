"""Plots: expressions along a motion over time."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from itertools import dropwhile, takewhile
from typing import TypeAlias

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from symbody.errors import ViewError
from symbody.symbolic import Expr
from symbody.symbolic.given.arguments import with_known_names
from symbody.view.drawable_motion import DrawableMotion
from symbody.view.figure import NotebookFigure, finished, symbol_of, with_unit
from symbody.view.overview import Group, overview
from symbody.view.plot_argument import checked_units
from symbody.view.pose import values

Panel: TypeAlias = Expr | Sequence[Expr] | Mapping[str, Expr]
"""The contents of a panel: an expression, several, or several by name."""

Units: TypeAlias = Mapping[Expr | str, str]

LONG = 24
"""The longest name, in letters, that is written next to an axis; longer ones are written above the panel."""

WIDE = 4
"""The number of panels from which there are two per row."""


@with_known_names
def plot(
    motion: DrawableMotion,
    *panels: Panel,
    units: Units | None = None,
    time: str = "s",
    title: str = "",
    path: str | os.PathLike[str] | None = None,
) -> Figure:
    """Return a figure of expressions over time, one panel for each argument.

    Without arguments, it shows all coordinates, speeds and states, in SI units: lengths, angles and others in separate
    panels.

    Args:
        motion: the motion.
        panels: an expression, a list of expressions that share a panel, or a dictionary of them by name.
        units: the unit of an expression or of the name of a curve. The axis shows the unit if all curves of a panel
            share it. By default, panels of angles, lengths or their rates are in SI units.
        time: the unit of time; the empty text for none.
        title: the title.
        path: a file to write as well; its suffix is the format, such as ``.png``, ``.svg`` or ``.pdf``. Its folder is
            made if necessary.

    Raises:
        ViewError: there is nothing to draw, a panel is not an expression, or a value is not finite.
        PictureError: the file can't be written.

    >>> import numpy as np
    >>> from types import SimpleNamespace
    >>> from symbody import Body, System, functions_of_time, translate
    >>> x = functions_of_time("x")
    >>> t = np.linspace(0, 1, 11)
    >>> system = System([Body(translate(x, 0, 0), 1)], coordinates=[x])
    >>> motion = SimpleNamespace(t=t, system=system, evaluate=lambda expressions: t**2)
    >>> plot(motion, x, units={x: "m"}).axes[0].get_ylabel()
    '$x$ [m]'
    """
    figure = figure_over(motion, with_unit("time", time), panels, checked_units(units, "plot"), time)
    return finished(figure, title or motion.system.name, path)


def figure_over(
    motion: DrawableMotion, label: str, panels: Sequence[Panel], units: Units, time: str
) -> Figure:
    """Return a figure of expressions over time or another abscissa, without a title.

    Args:
        motion: the motion; its instants may be other values as well.
        label: the name of the abscissa and its unit.
        panels: one for each argument of `plot`; without any, those of coordinates and speeds.
        units: the units of expressions or names of curves.
        time: the unit of time; the empty text for none.
    """
    groups = overview(motion.system)
    columns = _panels(panels, units, _kinds(groups, time)) if panels else _overview(groups, units, time)
    rows = max(map(len, columns))
    figure = NotebookFigure(figsize=(6.5 * len(columns) + 1, 2.4 * rows + 0.8), layout="constrained")
    grid = figure.subplots(rows, len(columns), sharex=True, squeeze=False)
    for places, column in zip(grid.T, columns, strict=True):
        for axes, panel in zip(places, column, strict=False):
            _draw(axes, motion, panel)
        for axes in places[len(column) :]:
            axes.set_visible(False)
        places[len(column) - 1].set_xlabel(label)
        places[len(column) - 1].tick_params(labelbottom=True)
    return figure


@dataclass(frozen=True)
class _Curves:
    """A panel: expressions by their names in the figure, their units, and their kind."""

    curves: Mapping[str, Expr]
    units: Sequence[str]
    kind: str = ""

    @property
    def unit(self) -> str:
        """The unit that all curves share; the empty text if there is none."""
        return self.units[0] if len(set(self.units)) == 1 else ""


LINKING = {"about", "along", "at", "in", "of", "on", "the"}
"""Words with which the name of an axis does not end, or begin."""

Groups: TypeAlias = tuple[list[Group], list[Group]]


def _kinds(groups: Groups, time: str) -> dict[Expr, tuple[str, str]]:
    """Return the kinds of coordinates and speeds, and their units."""
    return {
        name: (group.kind, group.unit(time))
        for part in groups
        for group in part
        for name in group.expressions
    }


def _panels(
    panels: Sequence[Panel], units: Units, kinds: Mapping[Expr, tuple[str, str]]
) -> list[list[_Curves]]:
    """Return the given panels by columns. Coordinates and speeds have the unit of their kind unless one is given."""
    found = []
    for curves in map(_curves, panels):
        shared = {kinds.get(expression, ("", "")) for expression in curves.values()}
        kind, unit = shared.pop() if len(shared) == 1 else ("", "")
        found.append(_panel(curves, units, kind or _common_words(curves), unit))
    columns = 2 if len(found) >= WIDE else 1
    rows = -(-len(found) // columns)
    return [found[k : k + rows] for k in range(0, len(found), rows)]


def _common_words(names: Iterable[str]) -> str:
    """Return the words with which all names begin, or else end.

    >>> _common_words(["kinetic energy", "potential energy"]), _common_words(["tension A", "tension B"])
    ('energy', 'tension')
    """
    words = [name.split() for name in names]
    for step in (1, -1):
        places = zip(*(each[::step] for each in words), strict=False)
        common = [place[0] for place in takewhile(lambda place: len(set(place)) == 1, places)]
        while common and common[-1] in LINKING:
            common.pop()
        if common and not any("$" in word for word in common):
            return " ".join(common[::step])
    return ""


def _distinction(name: str, common: str) -> str:
    """Return the part of a curve's name that is not in the name of its axis.

    >>> _distinction("tension A", "tension"), _distinction("speed of the rod", "speed"), _distinction("q1", "angle")
    ('A', 'rod', 'q1')
    """
    words = name.removeprefix(f"{common} ").removesuffix(f" {common}").split()
    if len(words) == len(name.split()):
        return name
    return " ".join(dropwhile(LINKING.__contains__, words)) or name


def _panel(curves: Mapping[str, Expr], units: Units, kind: str = "", unit: str = "") -> _Curves:
    if not curves:
        raise ViewError(
            "plot: a panel is empty; give an expression, a list of expressions, or leave the panel out"
        )
    given = [units.get(name, units.get(expression, unit)) for name, expression in curves.items()]
    return _Curves(curves, given, kind)


def _overview(groups: Groups, units: Units, time: str) -> list[list[_Curves]]:
    """Return the coordinates in one column, grouped by kind, and the speeds in another one."""
    return [
        [_panel(_curves(group.expressions), units, group.kind, group.unit(time)) for group in part]
        for part in groups
    ]


def _curves(panel: object) -> dict[str, Expr]:
    """Return the curves of a panel by their names in the figure."""
    if isinstance(panel, Expr):
        return {symbol_of(panel): panel}
    if isinstance(panel, Mapping):
        return {str(name): _checked(expression) for name, expression in panel.items()}
    if isinstance(panel, Iterable) and not isinstance(panel, str):
        return {symbol_of(_checked(expression)): expression for expression in panel}
    raise _strange(panel)


def _checked(expression: object) -> Expr:
    if not isinstance(expression, Expr):
        raise _strange(expression)
    return expression


def _strange(what: object) -> ViewError:
    return ViewError(
        f"plot: {what!r} is not a panel; expected an expression such as a coordinate, a list of expressions, or a "
        "dictionary of expressions by name"
    )


def _draw(axes: Axes, motion: DrawableMotion, panel: _Curves) -> None:
    rows = values(motion, list(panel.curves.values()))
    for name, unit, row in zip(panel.curves, panel.units, rows, strict=True):
        short = _distinction(name, panel.kind)
        label = short if panel.unit else with_unit(short, unit)
        axes.plot(motion.t, row, label=label, marker="o" if len(row) == 1 else "")
    name = next(iter(panel.curves)) if len(panel.curves) == 1 else panel.kind
    if len(name) > LONG and "$" not in name:
        axes.set_title(name, fontsize="medium")
        name = ""
    axes.set_ylabel(with_unit(name, panel.unit).strip())
    axes.grid(visible=True, alpha=0.3)
    axes.margins(x=0)
    axes.ticklabel_format(axis="y", useOffset=False)
    if len(panel.curves) > 1:
        axes.legend(loc="upper left", bbox_to_anchor=(1, 1), frameon=False)
