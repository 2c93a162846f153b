"""Plots in pgfplots, for LaTeX."""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import to_hex
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from symbody.document.formats.plain_text import text
from symbody.document.formats.tex_letter import in_formula

MOST = 400
"""The most points of a curve: more than a printed page resolves, and few enough for TeX's memory."""


def pgfplots(figure: Figure) -> str:
    r"""Return a figure as a picture of pgfplots, with the panels and the curves that it has.

    >>> figure = Figure()
    >>> curve = figure.subplots().plot([0, 1], [2, 3], label="$x$ [m]")
    >>> print(pgfplots(figure))
    \begin{tikzpicture}
    \begin{groupplot}[group style={group size=1 by 1, horizontal sep=2.4cm, vertical sep=0.9cm}, ...]
    \nextgroupplot[xlabel={}, ylabel={}]
    \addplot[color={rgb,255:red,31;green,119;blue,180}, thick] coordinates {(0,2) (1,3)};
    \end{groupplot}
    \end{tikzpicture}
    """
    rows, columns = figure.axes[0].get_subplotspec().get_gridspec().get_geometry()  # type: ignore[union-attr]
    group = f"group size={columns} by {rows}, horizontal sep=2.4cm, vertical sep=0.9cm"
    size = f"width={0.92 / columns:.2f}\\textwidth, height={'5cm' if columns == 1 else '4.2cm'}"
    look = "grid=major, grid style={gray!25}, enlarge x limits=false, label style={font=\\footnotesize}"
    look += ", tick label style={font=\\scriptsize}, title style={font=\\footnotesize}"
    legend = "legend style={draw=none, font=\\scriptsize}, legend pos=north west"
    places = sorted(figure.axes, key=lambda axes: axes.get_subplotspec().num1)  # type: ignore[union-attr]
    return "\n".join(
        [
            r"\begin{tikzpicture}",
            rf"\begin{{groupplot}}[group style={{{group}}}, {size}, {look}, {legend}]",
            *(line for axes in places for line in _panel(axes)),
            r"\end{groupplot}",
            r"\end{tikzpicture}",
        ]
    )


def _panel(axes: Axes) -> list[str]:
    """Return the commands of one panel; a hidden one keeps its place."""
    if not axes.get_visible():
        return [r"\nextgroupplot[group/empty plot]"]
    curves = axes.get_lines()
    title = f", title={{{_label(axes.get_title())}}}" if axes.get_title() else ""
    labels = f"xlabel={{{_label(axes.get_xlabel())}}}, ylabel={{{_label(axes.get_ylabel())}}}"
    commands = [rf"\nextgroupplot[{labels}{title}]"]
    for curve in curves:
        red, green, blue = (int(to_hex(curve.get_color())[k : k + 2], 16) for k in (1, 3, 5))
        color = f"color={{rgb,255:red,{red};green,{green};blue,{blue}}}"
        commands.append(rf"\addplot[{color}, thick] coordinates {{{_points(curve)}}};")
        if len(curves) > 1:
            commands.append(rf"\addlegendentry{{{_label(str(curve.get_label()))}}}")
    return commands


def _points(curve: Line2D) -> str:
    """Return the points of a curve, thinned to those that are seen."""
    x, y = (np.asarray(each, dtype=float) for each in curve.get_data())
    kept = np.unique(np.linspace(0, len(x) - 1, min(len(x), MOST)).round().astype(int))
    return " ".join(f"({a:.6g},{b:.6g})" for a, b in zip(x[kept], y[kept], strict=True))


def _label(label: str) -> str:
    """Return a label with its formulas; brackets around them protect commas and square brackets."""
    parts: Sequence[Any] = re.split(r"(\$[^$]*\$)", label)
    return "".join(in_formula(part) if part.startswith("$") else text(part) for part in parts)
