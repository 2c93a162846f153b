"""Solids: the extent of the parts of a page, and what they hide."""

from __future__ import annotations

from itertools import product
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

INSIDE = 0.9
"""A point is hidden if it is within the solid's box scaled by this factor."""

OUTSIDE = 1.2
"""A point is outside if it is beyond the solid's box scaled by this factor."""


def corners(part: dict[str, Any]) -> Array:
    """Return the corners of the box around a part, shape (8, 3), in the part's frame.

    >>> corners({"kind": "rod", "radius": 1, "from": [0, 0, 0], "to": [0, 0, 4]}).max(axis=0).tolist()
    [1.0, 1.0, 4.0]
    """
    center, half, axes = _box(part)
    return np.asarray(center + np.array(list(product((-1, 1), repeat=3))) * half @ axes.T)


def hides(part: dict[str, Any], places: Array) -> bool:
    """Return whether one of some points, given in the part's frame, is well inside the part."""
    return bool((_depths(part, places) < INSIDE).any())


def falls_short_of(part: dict[str, Any], places: Array) -> bool:
    """Return whether one of some points, given in the part's frame, is well outside the part."""
    return bool((_depths(part, places) > OUTSIDE).any())


def _depths(part: dict[str, Any], places: Array) -> Array:
    """Return the factors by which the box around a part must be scaled to reach points."""
    center, half, axes = _box(part)
    return np.asarray((np.abs((places - center) @ axes) / np.maximum(half, 1e-300)).max(axis=1, initial=0))


def _box(part: dict[str, Any]) -> tuple[Array, Array, Array]:
    """Return the centre, the half sides and the axes (columns) of the box around a part."""
    if part["kind"] == "rod":
        start, end = np.array(part["from"], dtype=float), np.array(part["to"], dtype=float)
        axes = np.linalg.svd((end - start)[None])[2].T
        half = np.array([np.linalg.norm(end - start) / 2, part["radius"], part["radius"]])
        return (start + end) / 2, half, axes
    if part["kind"] == "plate":
        flat = np.array(part["corners"], dtype=float)
        low, high = flat.min(axis=0), flat.max(axis=0)
        middle, size = (low + high) / 2, (high - low) / 2
        return np.array([*middle, part["z"]]), np.array([*size, part["thickness"] / 2]), np.eye(3)
    half = np.array(part["size"], dtype=float) / (2 if part["kind"] == "box" else 1)
    return np.array(part["at"], dtype=float), half, np.array(part.get("rotation", np.eye(3)), dtype=float)
