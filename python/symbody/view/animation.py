"""Animations: a motion as one page that needs nothing else."""

from __future__ import annotations

import html
import json
import os
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from importlib.resources import files
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from symbody.errors import ViewError
from symbody.geometry import Frame, Point
from symbody.multibody import Body, Load, System
from symbody.symbolic import Expr
from symbody.view.drawable_motion import DrawableMotion
from symbody.view.drawing_options import DrawingOptions
from symbody.view.scene import scene
from symbody.view.shape import Shape
from symbody.view.whole_file import file_of, write_whole

MOST = 1500
"""Instants of a page: a minute at 25 a second; the page goes smoothly from one to the next."""


def animate(
    motion: DrawableMotion,
    path: str | os.PathLike[str],
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
) -> Path:
    """Write a motion as a page for any browser: one file, without a network.

    Bodies without a shape are shown as the homogeneous box, cylinder, ball or rod of their mass and inertia, as glass
    if they hide a joint or another body. Rods are the constant distances of their chains of frames, and lead to the
    points where forces act; threads are the constant distances that constraints keep between natural coordinates.

    Args:
        motion: what is shown.
        path: the file, such as ``"plate.html"``; its folder is made if there is none.
        title: the headline; the name of the system by default.
        shapes: what bodies look like: one shape or several for each, in place of its solid and its rods.
        frames: those whose axes are shown.
        points: points that are shown with their names.
        traces: points that leave their paths.
        lines: pairs of points that are joined by a line, such as the ends of a thread.
        forces: whether the forces and torques of the system are shown as arrows; or those that are, which may hold
            multipliers and accelerations, such as the force in a joint. A torque has two heads.
        reactions: whether the forces of threads are shown.
        follow: a body with which the camera goes, such as a vehicle.

    Raises:
        ViewError: there is nothing to draw, a value isn't finite, what is asked for is of another kind, or the file's
            name isn't that of a page.
        PictureError: the file can't be written.
    """
    file = _page_file(path)
    loads = (motion.system.loads if forces else ()) if isinstance(forces, bool) else forces
    options = DrawingOptions(shapes or {}, frames, points, traces, lines, loads, reactions, follow)
    text = page(scene(thinned(motion), options, title or motion.system.name or "symbody"))
    return write_whole(file, lambda temporary: temporary.write_text(text, encoding="utf-8", newline="\n"))


def _page_file(path: str | os.PathLike[str]) -> Path:
    """Return the file of a page, which browsers know by its ending."""
    file = file_of(path)
    if file.suffix.lower() not in {".html", ".htm"}:
        raise ViewError(
            f"animate: {file} ends in {file.suffix!r}, and what is written is a page in HTML; expected a name such as "
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
    """Return a motion of no more instants than a page shows, as evenly spread as they can be."""
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
    def system(self) -> System:
        return self.motion.system

    def __getitem__(self, expression: Expr) -> NDArray[np.float64]:
        return np.asarray(self.motion[expression][self.kept])

    def evaluate(self, expressions: Sequence[Expr]) -> NDArray[np.float64]:
        rows = np.broadcast_to(self.motion.evaluate(expressions), (len(expressions), len(self.motion.t)))
        return np.asarray(rows[:, self.kept])
