"""Animations: a motion as one self-contained page."""

from __future__ import annotations

import html
import json
import os
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from importlib.resources import files
from pathlib import Path
from typing import overload

import numpy as np
from numpy.typing import NDArray

from symbody.errors import ViewError
from symbody.geometry import Frame, Point
from symbody.multibody import Body, Load, Variables
from symbody.symbolic import Expr
from symbody.symbolic.given.arguments import with_known_names
from symbody.view.drawable_motion import DrawableMotion, drawable, mechanism_of
from symbody.view.drawing_options import DrawingOptions
from symbody.view.scene import scene
from symbody.view.shape import Shape
from symbody.view.whole_file import file_of, write_whole

MOST = 1500
"""The most instants of a page: a minute at 25 per second; the page interpolates between them."""


@dataclass(frozen=True)
class Animation:
    """A page with a motion, which a notebook shows in a frame of its own.

    Attributes:
        title: the title of the page.
        page: the page in HTML; it needs no network.
    """

    title: str
    page: str = field(repr=False)

    def __repr__(self) -> str:
        size = f"{len(self.page) / 1e6:.1f} MB"
        return f'Animation({self.title}, {size}; a notebook shows it, animate("motion.html") writes it)'

    def _repr_html_(self) -> str:
        frame = 'width="100%" height="520" style="border: 1px solid #d5dce3" sandbox="allow-scripts"'
        return (
            f'<iframe title="{html.escape(self.title)}" {frame} srcdoc="{html.escape(self.page)}"></iframe>'
        )


@overload
def animate(
    motion: DrawableMotion,
    path: None = ...,
    *,
    title: str = ...,
    shapes: Mapping[Body, Shape | Sequence[Shape]] | None = ...,
    frames: Sequence[Frame] = ...,
    points: Sequence[Point] = ...,
    traces: Sequence[Point] = ...,
    lines: Sequence[tuple[Point, Point]] = ...,
    forces: bool | Sequence[Load] = ...,
    reactions: bool = ...,
    follow: Body | None = ...,
) -> Animation: ...


@overload
def animate(
    motion: DrawableMotion,
    path: str | os.PathLike[str],
    *,
    title: str = ...,
    shapes: Mapping[Body, Shape | Sequence[Shape]] | None = ...,
    frames: Sequence[Frame] = ...,
    points: Sequence[Point] = ...,
    traces: Sequence[Point] = ...,
    lines: Sequence[tuple[Point, Point]] = ...,
    forces: bool | Sequence[Load] = ...,
    reactions: bool = ...,
    follow: Body | None = ...,
) -> Path: ...


@with_known_names
def animate(
    motion: DrawableMotion,
    path: str | os.PathLike[str] | None = None,
    *,
    title: str = "",
    shapes: Mapping[Body, Shape | Sequence[Shape]] | None = None,
    frames: Sequence[Frame] = (),
    points: Sequence[Point] = (),
    traces: Sequence[Point] = (),
    lines: Sequence[tuple[Point, Point]] = (),
    forces: bool | Sequence[Load] = False,
    reactions: bool = False,
    follow: Body | None = None,
) -> Path | Animation:
    """Return a motion as a page that a notebook shows, or write the page for any browser; it needs no network.

    A body without a given shape is drawn as the homogeneous box, cylinder, ball or rod of its mass and inertia; it is
    transparent if it hides a joint or another body. Rods show the constant distances in the chains of frames and lead
    to the points where forces act. Threads show the constant distances that constraints keep between natural
    coordinates.

    Args:
        motion: the motion.
        path: the file, such as ``"plate.html"``; its folder is made if necessary. Without one, nothing is written.
        title: the title; by default the name of the system.
        shapes: the shapes of bodies, one or several for each, instead of its solid and its rods.
        frames: frames whose axes are drawn.
        points: points that are drawn with their names.
        traces: points whose paths are drawn.
        lines: pairs of points that are joined by a line, such as the ends of a thread.
        forces: whether the forces and torques of the system are drawn as arrows; or a list of those to draw, which may
            contain multipliers and accelerations, such as the force in a joint. A torque has two heads.
        reactions: whether the forces of threads are drawn.
        follow: a body that the camera follows, such as a vehicle.

    Returns:
        The path of the file; without one, the `Animation`, which a notebook shows (some 0.6 MB and the motion).

    Raises:
        ViewError: there is nothing to draw, a value is not finite, an argument has the wrong kind, or the file name
            does not end in .html or .htm.
        PictureError: the file can't be written.

    >>> import tempfile
    >>> import symbody as sb
    >>> x, (m, k) = sb.functions_of_time("x"), sb.symbols("m k")
    >>> cart = sb.Body(sb.translate(x, 0, 0), m)
    >>> spring = sb.Force(sb.ground, -k * x, 0, 0, at=cart.center_of_mass, on=cart)
    >>> oscillator = sb.newton_euler(sb.System([cart], [spring], coordinates=[x]))
    >>> motion = sb.simulate(oscillator, {m: 1, k: 4}, {x: 0.1}, t=(0, 1))
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     page_file = animate(motion, Path(folder) / "oscillator.html", traces=[cart.center_of_mass])
    ...     page_file.name, page_file.stat().st_size > 100_000
    ('oscillator.html', True)
    >>> "<iframe" in animate(motion)._repr_html_()
    True
    """
    file = None if path is None else _page_file(path)
    motion = drawable(motion, "animate")
    loads = (mechanism_of(motion).loads if forces else ()) if isinstance(forces, bool) else forces
    options = DrawingOptions(shapes or {}, frames, points, traces, lines, loads, reactions, follow)
    name = title or motion.system.name or "symbody"
    text = page(scene(thinned(motion), options, name))
    if file is None:
        return Animation(name, text)
    return write_whole(file, lambda temporary: temporary.write_text(text, encoding="utf-8", newline="\n"))


def _page_file(path: str | os.PathLike[str]) -> Path:
    """Return the path of the page; its suffix must be one of HTML."""
    file = file_of(path)
    if file.suffix.lower() not in {".html", ".htm"}:
        raise ViewError(
            f"animate: {file} ends in {file.suffix!r}, but the page is written in HTML; expected a name such as "
            f"{file.stem}.html"
        )
    return file


def page(content: Mapping[str, object]) -> str:
    """Return the page of a scene.

    >>> "three.js" in page({"title": "Top"})
    True
    """
    data = json.dumps(content, separators=(",", ":"), allow_nan=False).replace("<", "\\u003c")
    parts = {
        "title": html.escape(str(content["title"])),
        "licence": _read("LICENSE.three"),
        "three": _read("three.min.js"),
        "viewer": _read("viewer.js"),
        "scene": data,
    }
    return re.sub(r"\{\{(\w+)\}\}", lambda place: parts[place[1]], _read("page.html"))


def _read(name: str) -> str:
    return files(__package__).joinpath("page", name).read_text(encoding="utf-8")


def thinned(motion: DrawableMotion) -> DrawableMotion:
    """Return a motion with no more instants than a page shows, as evenly spaced as possible."""
    if len(motion.t) <= MOST:
        return motion
    wanted = np.linspace(motion.t[0], motion.t[-1], MOST)
    kept = np.unique(np.searchsorted(motion.t, wanted).clip(0, len(motion.t) - 1))
    return _Thinned(motion, kept)


@dataclass(frozen=True)
class _Thinned:
    """Some instants of a motion."""

    motion: DrawableMotion
    kept: NDArray[np.intp]

    @property
    def t(self) -> NDArray[np.float64]:
        return np.asarray(self.motion.t[self.kept])

    @property
    def system(self) -> Variables:
        return self.motion.system

    def __getitem__(self, expression: Expr) -> NDArray[np.float64]:
        return np.asarray(self.motion[expression][self.kept])

    def evaluate(self, expressions: Sequence[Expr]) -> NDArray[np.float64]:
        rows = np.broadcast_to(self.motion.evaluate(expressions), (len(expressions), len(self.motion.t)))
        return np.asarray(rows[:, self.kept])
