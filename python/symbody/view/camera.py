"""The camera: its direction, and what it must show."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from symbody.view.pose import rounded

Array = NDArray[np.float64]

FLAT = 0.02
"""A motion is flat if the ratio of its thickness to its extent is smaller."""

DIRECTIONS = 100

AXES = 0.25
"""The distance of the axis labels of ground from its origin, in radii of the picture; `viewer.js` draws them."""


@dataclass(frozen=True)
class View:
    """The ball that contains the whole motion, the upward direction, and the direction from the ball to the camera."""

    center: Array
    radius: float
    up: Array
    direction: Array
    floor: float
    """The height of the lowest point, along ``up``."""
    extremes: Array
    """The outermost points in many directions, which the picture must contain."""

    def holding(self, places: Array) -> View:
        """Return the same view at a distance that shows more points."""
        return replace(self, extremes=_extremes(np.concatenate([self.extremes, places])))

    def holding_axes(self) -> View:
        """Return the same view with the axes of ground, if their origin is in the picture."""
        if np.linalg.norm(self.center) > self.radius:
            return self
        return self.holding(AXES * self.radius * np.eye(3))

    @property
    def entry(self) -> dict[str, Any]:
        """The entry of the page."""
        return {
            "center": self.center.tolist(),
            "radius": self.radius,
            "up": self.up.tolist(),
            "direction": self.direction.tolist(),
            "floor": self.floor,
            "extremes": [rounded(point) for point in self.extremes],
        }


def view_of(places: Array, core: Array, up: Array) -> View:
    """Return a view of points, shape (k, 3), with the given upward direction.

    Flat motions, whose core (centres, points, segments) lies in a plane, are seen nearly from the front, others from
    above a corner.
    """
    low, high = places.min(axis=0), places.max(axis=0)
    center = (low + high) / 2
    radius = float(np.linalg.norm(places - center, axis=1).max()) or 1.0
    _, extents, axes = np.linalg.svd(core - core.mean(axis=0), full_matrices=False)
    is_flat = len(extents) == 3 and extents[2] < FLAT * extents[0] and extents[1] > FLAT * extents[0]
    direction = _direction(axes[2] if is_flat else None, up)
    return View(center, radius, up, direction, float((places @ up).min()), _extremes(places))


def _extremes(places: Array) -> Array:
    """Return the outermost points in directions that are evenly spread over the sphere (a spiral)."""
    k = np.arange(DIRECTIONS) + 0.5
    height, angle = 1 - 2 * k / DIRECTIONS, k * np.pi * (1 + 5**0.5)
    ring = np.sqrt(1 - height**2)
    sides = np.column_stack([ring * np.cos(angle), ring * np.sin(angle), height])
    found = {int(np.argmax(places @ side)): None for side in sides}
    return places[list(found)]


def _direction(normal: Array | None, up: Array) -> Array:
    """Return the normal of a flat motion, from slightly above; or a horizontal direction along no axis."""
    side = _front(up)
    if normal is not None and abs(normal @ up) < 0.9:
        across = normal - (normal @ up) * up
        across *= np.sign(across @ side + 1e-3 * across.sum()) or 1.0
        direction = across / np.linalg.norm(across) + 0.22 * up + 0.25 * np.cross(up, across)
    else:
        direction = side + 0.45 * np.cross(up, side) + (2.0 if normal is not None else 0.5) * up
    return np.asarray(direction / np.linalg.norm(direction))


def _front(up: Array) -> Array:
    """Return the direction towards the reader in drawings: z if y is up, minus y if z is up."""
    axis = int(np.argmax(np.abs(up)))
    front = np.array([[0.0, 0, 1], [0, 0, 1], [0, -1, 0]][axis])
    across = front - (front @ up) * up
    return np.asarray(across / np.linalg.norm(across))
