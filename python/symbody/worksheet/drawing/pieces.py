"""Drawings: the pieces of a plot, and files in the output folder that show them."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from symbody.deferred import Deferred
from symbody.symbolic import Expr
from symbody.worksheet.evaluation.session import Session
from symbody.worksheet.values.value import Listed, Plot, Range, Value

if TYPE_CHECKING:
    import numpy as np
    from matplotlib.axes import Axes
    from numpy.typing import NDArray
else:
    np = Deferred("numpy")


__all__ = ["Piece", "drawn", "pieces_of"]

_FRAMES = 200
"""The most pictures of an animation."""


@dataclass(frozen=True)
class Piece:
    """A part of a drawing.

    Attributes:
        kind: "curve", "points", "area", "surface" or "text".
        points: a row of two or three coordinates for each point.
        labels: the names of the axes, or the text.
        color: a name of a colour, or nothing; Maple's names of colours are those of web pages.
        name: what the legend calls it.
        line: how a curve is drawn: "solid", "dashed", "dotted" or "dashdot".
        width: the width of a curve in points; nothing for the usual one.
        rows: how many rows the points of a surface have.
    """

    kind: str
    points: NDArray[np.float64]
    labels: tuple[str, ...] = ()
    color: str = ""
    name: str = ""
    line: str = "solid"
    width: float | None = None
    rows: int = 0


def pieces_of(plot: Plot) -> list[Piece]:
    """Return the pieces of a drawing and of those inside it."""
    found: list[Piece] = []
    for each in plot.data:
        found += pieces_of(each) if isinstance(each, Plot) else [each]
    return found


def drawn(session: Session, plot: Plot) -> str:
    """Draw into a new file of the output folder, and return what the sheet prints of it."""
    animated = plot.kind == "animation"
    session.drawings += 1
    path = session.folder / f"plot{session.drawings}.{'html' if animated else 'png'}"
    session.folder.mkdir(parents=True, exist_ok=True)
    frames = [pieces_of(each) for each in plot.data] if animated else [pieces_of(plot)]
    options = dict(plot.options)
    try:
        _write(path, frames[:_FRAMES], options)
    except (ValueError, TypeError, OSError) as fault:
        session.notices.append(f"the drawing could not be made: {fault}")
        return "[Plot]"
    return f"[Plot: {path.name}]"


_BOX = (0.08, 0.06, 0.84, 0.86)
"""The place of spatial axes: to find it from their labels draws them twice."""


def _write(path: Path, frames: list[list[Piece]], options: dict[str, Value]) -> None:
    from matplotlib.animation import FuncAnimation  # noqa: PLC0415 - loaded for the first drawing
    from matplotlib.figure import Figure  # noqa: PLC0415

    solid = any(piece.points.shape[1] == 3 for frame in frames for piece in frame)
    figure = Figure(figsize=(6, 4), layout=None if solid else "constrained")
    axes: Any = figure.add_axes(_BOX, projection="3d") if solid else figure.add_subplot()
    if path.suffix == ".png":
        _fill(axes, frames[0], options)
        figure.savefig(path, dpi=120)
        return
    limits = _limits(frames)

    def step(k: int) -> Iterable[Any]:
        axes.clear()
        _fill(axes, frames[k], options)
        for name, (low, high) in zip("xyz", limits, strict=False):
            getattr(axes, f"set_{name}lim")(low, high)
        return ()

    animation = FuncAnimation(figure, step, frames=len(frames), interval=50)
    path.write_text(_with_symbols(animation.to_jshtml()), encoding="utf-8")


_SYMBOLS = {
    "minus": "\u2212",
    "fast-backward": "|\u25c0\u25c0",
    "step-backward": "|\u25c0",
    "play fa-flip-horizontal": "\u25c0",
    "pause": "||",
    "play": "\u25b6",
    "step-forward": "\u25b6|",
    "fast-forward": "\u25b6\u25b6|",
    "plus": "+",
}
"""Characters for the symbols of the buttons, which Matplotlib's page takes from the network."""


def _with_symbols(page: str) -> str:
    """Return the page of an animation with buttons that show without the network, and without a random name."""
    name = re.search(r"anim([0-9a-f]{32})", page)
    page = page.replace(name[1], "") if name else page
    page = re.sub(r'<link rel="stylesheet"\s+href="https?:[^>]*>', "", page)
    for kind, symbol in _SYMBOLS.items():
        page = page.replace(f'<i class="fa fa-{kind}"></i>', symbol)
    return page


def _limits(frames: list[list[Piece]]) -> list[tuple[float, float]]:
    """Return the limits that hold all pictures, so that nothing jumps."""
    all_points = np.concatenate([piece.points for frame in frames for piece in frame])
    low, high = np.nanmin(all_points, axis=0), np.nanmax(all_points, axis=0)
    margin = 0.05 * max(float(np.max(high - low)), 1e-9)
    return [(float(a) - margin, float(b) + margin) for a, b in zip(low, high, strict=True)]


def _fill(axes: Axes, pieces: list[Piece], options: dict[str, Value]) -> None:
    for piece in pieces:
        _add(axes, piece)
    _label(axes, pieces, options)
    if "title" in options:
        axes.set_title(_words(options["title"]))
    if _words(options.get("scaling", "")).lower() == "constrained":
        axes.set_aspect("equal")
    if _words(options.get("gridlines", "")).lower() == "true":
        axes.grid(visible=True)
    if _words(options.get("axes", "")).lower() == "none":
        axes.set_axis_off()
    for axis in _words(options.get("logarithmic", "")):
        getattr(axes, f"set_{axis}scale")("log")
    _set_view(axes, options.get("view"))


def _words(value: object) -> str:
    """Return the text that an option is."""
    truth = getattr(value, "truth", None)
    return str(truth).lower() if isinstance(truth, bool) else str(getattr(value, "text", value))


def _label(axes: Any, pieces: list[Piece], options: dict[str, Value]) -> None:
    """Name the axes: as the option ``labels`` says, or as the curves have them; several curves have a legend."""
    curves = [piece for piece in pieces if piece.kind in {"curve", "points", "surface"}]
    labelled = [piece.labels for piece in curves if piece.labels]
    given = options.get("labels")
    if isinstance(given, Listed):
        names = [_words(each) for each in given.items]
    elif labelled and all(labels[0] == labelled[0][0] for labels in labelled):
        names = list(labelled[0]) if len(curves) == 1 else [labelled[0][0]]
    else:
        names = []
    for axis, name in zip("xyz", names, strict=False):
        getattr(axes, f"set_{axis}label")(name)
    if any(piece.name for piece in curves) or (len(curves) > 1 and labelled):
        axes.legend(loc="best", fontsize="small")


def _set_view(axes: Any, view: object) -> None:
    """Set the limits of the axes: ``view = [a..b, c..d]``, or ``view = c..d`` of the last axis."""
    ranges = dict(zip("xyz", view.items, strict=False)) if isinstance(view, Listed) else {"y": view}
    for axis, span in ranges.items():
        if isinstance(span, Range) and hasattr(axes, f"set_{axis}lim"):
            ends = [
                float(end) for end in (span.start, span.stop) if isinstance(end, Expr) and end.is_constant
            ]
            if len(ends) == 2:
                getattr(axes, f"set_{axis}lim")(*ends)


def _add(axes: Any, piece: Piece) -> None:
    from matplotlib.colors import is_color_like  # noqa: PLC0415 - loaded for the first drawing

    columns = list(piece.points.T)
    color = {"color": piece.color} if len(piece.color) > 1 and is_color_like(piece.color) else {}
    if piece.kind == "text":
        axes.text(*(column[0] for column in columns), piece.labels[0], **color)
    elif piece.kind == "points":
        axes.plot(*columns, "o", markersize=4, label=piece.name or None, **color)
    elif piece.kind == "surface":
        mesh = (column.reshape(piece.rows, -1) for column in columns)
        axes.plot_surface(*mesh, **(color or {"cmap": "viridis"}))
    elif piece.kind == "area" and len(columns) == 2:
        axes.fill(*columns, alpha=0.6, **color)
    else:
        name = piece.name or (piece.labels[-1] if piece.labels else None)
        axes.plot(*columns, label=name, linestyle=piece.line, linewidth=piece.width, **color)
