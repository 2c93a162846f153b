"""Drawings as SVG: sketches, and figures of matplotlib without anything that changes from run to run."""

from __future__ import annotations

from html import escape
from io import StringIO

import matplotlib as mpl
from matplotlib.figure import Figure

from symbody.view.mark import Dot, Ellipse, Label, Line, Mark, Patch, Sketch


def sketch_svg(drawing: Sketch) -> str:
    """Return a sketch as an image.

    >>> print(sketch_svg(Sketch(20, 10, (Dot((1, 2), "#000000", 3),))))
    <svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 20 10" width="20" height="10" font-family="sans-serif">
    <circle cx="1" cy="2" r="3" fill="#000000"/>
    </svg>
    """
    size = f'viewBox="0 0 {drawing.width:g} {drawing.height:g}" width="{drawing.width:g}" height="{drawing.height:g}"'
    head = f'<svg xmlns="http://www.w3.org/2000/svg" {size} font-family="sans-serif">'
    return "\n".join([head, *map(_element, drawing.marks), "</svg>"])


def _element(mark: Mark) -> str:
    match mark:
        case Patch():
            corners = " ".join(f"{x:g},{y:g}" for x, y in mark.corners)
            return f'<polygon points="{corners}" {_filled(mark)} stroke-linejoin="round"/>'
        case Ellipse():
            (x, y), (a, b) = mark.at, mark.radii
            turn = f' transform="rotate({mark.turn:g} {x:g} {y:g})"' if mark.turn else ""
            return f'<ellipse cx="{x:g}" cy="{y:g}" rx="{a:g}" ry="{b:g}" {_filled(mark)}{turn}/>'
        case Line():
            (x1, y1), (x2, y2) = mark.start, mark.end
            look = f'stroke="{mark.color}" stroke-width="{mark.width:g}" stroke-linecap="round"'
            dashes = ' stroke-dasharray="6 4"' if mark.is_dashed else ""
            return f'<line x1="{x1:g}" y1="{y1:g}" x2="{x2:g}" y2="{y2:g}" {look}{dashes}/>'
        case Dot():
            x, y = mark.at
            return f'<circle cx="{x:g}" cy="{y:g}" r="{mark.radius:g}" fill="{mark.color}"/>'
        case Label():
            x, y = mark.at
            halo = 'stroke="#ffffff" stroke-width="3" paint-order="stroke"'
            return f'<text x="{x:g}" y="{y:g}" font-size="13" fill="{mark.color}" {halo}>{escape(mark.text)}</text>'


def _filled(mark: Patch | Ellipse) -> str:
    return f'fill="{mark.color}" fill-opacity="{mark.opacity:g}" stroke="{mark.color}" stroke-width="1"'


def figure_svg(figure: Figure) -> str:
    """Return a figure as an image, with the same text in each run: without its date, and with fixed identifiers.

    >>> figure_svg(Figure()).startswith("<svg")
    True
    """
    content = StringIO()
    with mpl.rc_context({"svg.hashsalt": "symbody"}):
        figure.savefig(content, format="svg", metadata=dict.fromkeys(("Creator", "Date", "Format", "Type")))
    text = content.getvalue()
    return text[text.index("<svg") :].strip()
