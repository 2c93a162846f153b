"""Sketches in TikZ, for LaTeX."""

from __future__ import annotations

from symbody.document.formats.plain_text import text
from symbody.view.mark import Dot, Ellipse, Label, Line, Mark, Patch, Sketch

UNIT = "0.7pt"
"""The length of a point of the sketch on paper."""


def tikz(drawing: Sketch) -> str:
    r"""Return a sketch as a picture of TikZ.

    >>> print(tikz(Sketch(20, 10, (Dot((1, 2), "#000000", 3),))))
    \begin{tikzpicture}[x=0.7pt, y=-0.7pt, font=\sffamily\footnotesize]
    \definecolor{color0}{HTML}{000000}
    \fill[color0] (1,2) circle[radius=1.8pt];
    \end{tikzpicture}
    """
    colors = {
        color: f"color{k}" for k, color in enumerate(dict.fromkeys(mark.color for mark in drawing.marks))
    }
    lines = [rf"\begin{{tikzpicture}}[x={UNIT}, y=-{UNIT}, font=\sffamily\footnotesize]"]
    lines += [rf"\definecolor{{{name}}}{{HTML}}{{{_html(color)}}}" for color, name in colors.items()]
    lines += [_path(mark, colors[mark.color]) for mark in drawing.marks]
    return "\n".join([*lines, r"\end{tikzpicture}"])


def _html(color: str) -> str:
    return color.removeprefix("#").upper()


def _path(mark: Mark, color: str) -> str:
    match mark:
        case Patch():
            corners = " -- ".join(f"({x:g},{y:g})" for x, y in mark.corners)
            return rf"\filldraw[{_filled(mark, color)}] {corners} -- cycle;"
        case Ellipse():
            # With y down, TikZ rotates about a centre that is shifted first, in the sense of the picture.
            (x, y), (a, b) = mark.at, mark.radii
            look = f"{_filled(mark, color)}, shift={{({x:g},{y:g})}}, rotate={mark.turn:g}"
            return rf"\filldraw[{look}] (0,0) ellipse[x radius={a:g}, y radius={b:g}];"
        case Line():
            (x1, y1), (x2, y2) = mark.start, mark.end
            look = f"{color}, line width={0.6 * mark.width:g}pt, line cap=round" + ", dashed" * mark.is_dashed
            return rf"\draw[{look}] ({x1:g},{y1:g}) -- ({x2:g},{y2:g});"
        case Dot():
            x, y = mark.at
            return rf"\fill[{color}] ({x:g},{y:g}) circle[radius={0.6 * mark.radius:g}pt];"
        case Label():
            x, y = mark.at
            return rf"\node[{color}, anchor=base west, inner sep=0pt] at ({x:g},{y:g}) {{{text(mark.text)}}};"


def _filled(mark: Patch | Ellipse, color: str) -> str:
    return f"draw={color}, fill={color}, fill opacity={mark.opacity:g}"
