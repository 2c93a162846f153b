"""Marks: the flat shapes of a drawing, which any format of vector graphics can contain."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

Place: TypeAlias = tuple[float, float]


@dataclass(frozen=True)
class Patch:
    """A filled polygon."""

    corners: tuple[Place, ...]
    color: str
    opacity: float


@dataclass(frozen=True)
class Ellipse:
    """A filled ellipse, by its centre, its semi-axes, and the angle from the x axis to the first one, in degrees."""

    at: Place
    radii: Place
    turn: float
    color: str
    opacity: float


@dataclass(frozen=True)
class Line:
    """A straight line."""

    start: Place
    end: Place
    color: str
    width: float
    is_dashed: bool = False


@dataclass(frozen=True)
class Dot:
    """A small disc."""

    at: Place
    color: str
    radius: float


@dataclass(frozen=True)
class Label:
    """A name beside a place."""

    at: Place
    text: str
    color: str


Mark: TypeAlias = Patch | Ellipse | Line | Dot | Label


@dataclass(frozen=True)
class Sketch:
    """A drawing: its size in points, and its marks from back to front; the y axis points down."""

    width: float
    height: float
    marks: tuple[Mark, ...]


def outermost(mark: Mark) -> tuple[Place, ...]:
    """Return places that are as far out as a mark, without the letters of its name."""
    match mark:
        case Patch(corners=corners):
            return corners
        case Ellipse(at=(x, y), radii=(a, b), turn=turn):
            c, s = np.cos(np.radians(turn)), np.sin(np.radians(turn))
            across, down = float(np.hypot(a * c, b * s)), float(np.hypot(a * s, b * c))
            return ((x - across, y - down), (x + across, y + down))
        case Line(start=start, end=end):
            return (start, end)
        case _:
            return (mark.at,)
