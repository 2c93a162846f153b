"""Drawings: the pieces of a plot, and files in the output folder that show them."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from symbody.deferred import Deferred
from symbody.worksheet.session import Session
from symbody.worksheet.value import Plot, Value

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
        kind: "curve", "points", "area" or "text".
        points: a row of two or three coordinates for each point.
        labels: the names of the axes, or the text.
        color: a name of a colour, or nothing.
    """

    kind: str
    points: NDArray[np.float64]
    labels: tuple[str, ...] = ()
    color: str = ""


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


def _write(path: Path, frames: list[list[Piece]], options: dict[str, Value]) -> None:
    from matplotlib.animation import FuncAnimation  # noqa: PLC0415 - loaded for the first drawing
    from matplotlib.figure import Figure  # noqa: PLC0415

    figure = Figure(figsize=(6, 4), layout="constrained")
    solid = any(piece.points.shape[1] == 3 for frame in frames for piece in frame)
    axes: Any = figure.add_subplot(projection="3d" if solid else None)
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
    path.write_text(animation.to_jshtml(), encoding="utf-8")


def _limits(frames: list[list[Piece]]) -> list[tuple[float, float]]:
    """Return the limits that hold all pictures, so that nothing jumps."""
    all_points = np.concatenate([piece.points for frame in frames for piece in frame])
    low, high = np.nanmin(all_points, axis=0), np.nanmax(all_points, axis=0)
    margin = 0.05 * max(float(np.max(high - low)), 1e-9)
    return [(float(a) - margin, float(b) + margin) for a, b in zip(low, high, strict=True)]


def _fill(axes: Axes, pieces: list[Piece], options: dict[str, Value]) -> None:
    for piece in pieces:
        _add(axes, piece)
    labels = next((piece.labels for piece in pieces if piece.kind == "curve" and piece.labels), ())
    if len(labels) > 1 and len(pieces) == 1:
        axes.set_xlabel(labels[0])
        axes.set_ylabel(labels[1])
    elif any(piece.labels for piece in pieces if piece.kind == "curve"):
        axes.legend(loc="best", fontsize="small")
    if "title" in options:
        axes.set_title(str(getattr(options["title"], "text", options["title"])))
    if str(options.get("scaling", "")).lower() == "constrained":
        axes.set_aspect("equal")


def _add(axes: Any, piece: Piece) -> None:
    columns = list(piece.points.T)
    color = {"color": piece.color} if piece.color else {}
    if piece.kind == "text":
        axes.text(*(column[0] for column in columns), piece.labels[0], **color)
    elif piece.kind == "points":
        axes.plot(*columns, "o", markersize=4, **color)
    elif piece.kind == "area" and len(columns) == 2:
        axes.fill(*columns, alpha=0.6, **color)
    else:
        axes.plot(*columns, label=piece.labels[-1] if piece.labels else None, **color)
