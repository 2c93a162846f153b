"""Attachments: points of a model that move with its bodies, and threads between them.

With relative coordinates, frames place points. Natural coordinates [de Jalon & Bayo 1994] are themselves the places of
points: ``xA, yA, zA``. What their names suggest is drawn only if the motion confirms it.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from symbody.geometry import Point, Vector
from symbody.multibody import System
from symbody.symbolic import Expr, number
from symbody.view.pose import relative_path

Array = NDArray[np.float64]

RIGID = 1e-3
"""The largest displacement of a point relative to a body on which it is fixed, relative to the size of the picture."""


@dataclass(frozen=True)
class Thread:
    """A constant distance that a constraint keeps, and its force at the start."""

    start: Point
    end: Point
    force: Vector


@dataclass(frozen=True)
class Attachment:
    """A point that is fixed to a body."""

    body: int
    place: Array
    """Its coordinates in the frame of the body at its centre of mass."""


def threads(system: System, points: Sequence[Point]) -> list[Thread]:
    """Return the threads by constraints of the form ``|P - P0|^2 = l^2``, with P among the given points."""
    found: list[Thread] = []
    whole = system.whole if system.left_out else system
    for constraint, multiplier in ((whole.constraints[k], whole.multipliers[k]) for k in whole.holonomic):
        for point in points:
            thread = _thread(constraint, multiplier, point)
            if thread is not None and (thread.end, thread.start) not in [(a.start, a.end) for a in found]:
                found.append(thread)
    return found


def _thread(constraint: Expr, multiplier: Expr, point: Point) -> Thread | None:
    """Return the thread of ``k/2 (|P - P0|^2 - l^2) = 0``: the gradient is ``k (P - P0)``, the second derivative k."""
    place = point.coordinates
    leaves = constraint.free_symbols
    free = [axis for axis in range(3) if not place[axis].is_zero]
    if not all(place[axis] in leaves for axis in free):
        return None
    slope = [constraint.diff(place[axis]) if axis in free else number(0) for axis in range(3)]
    stiffness = slope[free[0]].diff(place[free[0]])
    if stiffness.is_zero or stiffness.depends_on_time:
        return None
    second = ((i, j, slope[i].diff(place[j])) for i in free for j in free)
    if any(value != (stiffness if i == j else number(0)) for i, j, value in second):
        return None
    arm = [x / stiffness for x in slope]
    rest = constraint - stiffness / 2 * sum(x**2 for x in arm)
    if any(not rest.diff(leaf).is_zero for leaf in leaves if leaf.depends_on_time):
        return None
    end = Point(point.frame, *(x - d for x, d in zip(place, arm, strict=True)))
    return Thread(point, end, Vector(point.frame, *(multiplier * x for x in slope)))


def attachment(tracks: Array | Sequence[Array], path: Array, size: float) -> Attachment | None:
    """Return the attachment of a point to a body along a motion: to the nearest one if there are several.

    Args:
        tracks: the poses of the bodies, shape (bodies, N, 7).
        path: the places of the point, shape (N, 3).
        size: the size of the picture.
    """
    found = []
    for number_, track in enumerate(tracks):
        seen = relative_path(track, path)
        if np.ptp(seen, axis=0).max() < RIGID * size:
            found.append(Attachment(number_, seen.mean(axis=0)))
    return min(found, key=lambda each: float(np.linalg.norm(each.place)), default=None)
