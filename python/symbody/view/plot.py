"""Plots: outputs of a motion over time."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TypeAlias

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from symbody.errors import ViewError
from symbody.symbolic import Expr
from symbody.view.motion import Motion
from symbody.view.pose import values
from symbody.view.whole_file import write_whole

Panel: TypeAlias = Expr | Sequence[Expr] | Mapping[str, Expr]
"""What one pair of axes shows: an expression, several, or several by the names to show."""

LONG = 24
"""Letters of the longest name that stands beside an axis; longer ones stand above the panel."""

WIDE = 4
"""Panels from which there are two in a row."""


def plot(
    motion: Motion,
    *panels: Panel,
    units: Mapping[Expr | str, str] | None = None,
    time: str = "s",
    title: str = "",
    path: str | os.PathLike[str] | None = None,
) -> Figure:
    """Return a figure of outputs over time, a panel for each argument; all coordinates by default.

    Args:
        motion: what is shown.
        panels: an expression, a list of expressions that share a panel, or a dictionary of them by name.
        units: the unit of an expression, or of a name; those of a panel that agree stand at its axis.
        time: the unit of time; the empty text if there is none.
        title: the headline.
        path: a file to write as well; its ending says the format, such as ``.png``, ``.svg`` or ``.pdf``.

    Raises:
        ViewError: there is nothing to draw, or a value isn't finite.
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
    chosen = panels or motion.system.coordinates
    curves = [_curves(panel) for panel in chosen]
    if not all(curves):
        raise ViewError(
            "plot: a panel is empty; give an expression, a list of expressions, or leave the panel out"
        )
    columns = 2 if len(chosen) >= WIDE else 1
    rows = -(-len(chosen) // columns)
    figure = Figure(figsize=(6.5 * columns + 1, 2.4 * rows + 0.8), layout="constrained")
    grid = figure.subplots(rows, columns, sharex=True, squeeze=False)
    for axes, curve in zip(grid.T.ravel(), curves, strict=False):
        _draw(axes, motion, curve, units or {})
    for axes in grid.T.ravel()[len(chosen) :]:
        axes.set_visible(False)
    _label_time(grid, len(chosen), f"time [{time}]" if time else "time")
    if title or motion.system.name:
        figure.suptitle(title or motion.system.name)
    if path is not None:
        save(figure, path)
    return figure


def save(figure: Figure, path: str | os.PathLike[str]) -> Path:
    """Write a figure to a file, whole or not at all; the ending says the format.

    Raises:
        PictureError: the file can't be written.
        ViewError: the ending is of no format.
    """
    file = Path(path)
    kind = file.suffix.removeprefix(".").lower()
    known = figure.canvas.get_supported_filetypes()
    if kind not in known:
        raise ViewError(
            f"plot: {file} ends in {kind!r}; expected a format such as {', '.join(sorted(known))}"
        )
    return write_whole(file, lambda temporary: figure.savefig(temporary, format=kind, dpi=150))


def _curves(panel: Panel) -> dict[str, Expr]:
    """Return the curves of a panel by the names that stand in the figure."""
    if isinstance(panel, Expr):
        return {_symbol(panel): panel}
    if isinstance(panel, Mapping):
        return dict(panel)
    return {_symbol(expression): expression for expression in panel}


def _symbol(expression: Expr) -> str:
    """Return an expression in mathematical type if that is short, and as matplotlib can set it."""
    text = str(expression)
    latex = expression.latex()
    return f"${latex}$" if len(text) <= 40 and not {"begin", "text"} & set(latex.split("\\")) else text[:60]


def _draw(axes: Axes, motion: Motion, curves: Mapping[str, Expr], units: Mapping[Expr | str, str]) -> None:
    for (name, expression), row in zip(curves.items(), values(motion, list(curves.values())), strict=True):
        unit = units.get(name, units.get(expression, ""))
        _line(axes, motion.t, row, name, unit if len(curves) > 1 and not _common(curves, units) else "")
    unit = _common(curves, units)
    name = next(iter(curves)) if len(curves) == 1 else ""
    if len(name) > LONG and "$" not in name:
        axes.set_title(name, fontsize="medium")
        name = ""
    axes.set_ylabel(f"{name} [{unit}]".strip() if unit else name)
    axes.grid(visible=True, alpha=0.3)
    axes.margins(x=0)
    if len(curves) > 1:
        axes.legend(loc="upper left", bbox_to_anchor=(1, 1), frameon=False)


def _line(axes: Axes, t: NDArray[np.float64], row: NDArray[np.float64], name: str, unit: str) -> None:
    axes.plot(t, row, label=f"{name} [{unit}]" if unit else name, marker="o" if len(t) == 1 else "")


def _common(curves: Mapping[str, Expr], units: Mapping[Expr | str, str]) -> str:
    """Return the unit that all curves share, if there is one."""
    found = {units.get(name, units.get(expression, "")) for name, expression in curves.items()}
    return found.pop() if len(found) == 1 else ""


def _label_time(grid: NDArray[np.object_], panels: int, text: str) -> None:
    """Write the name of time below the last panel of each column."""
    rows = grid.shape[0]
    for column in range(grid.shape[1]):
        last = min(rows, panels - column * rows) - 1
        grid[last, column].set_xlabel(text)
        grid[last, column].tick_params(labelbottom=True)
