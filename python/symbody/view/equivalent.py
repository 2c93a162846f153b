"""The homogeneous solid that is equivalent to a mass and an inertia."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

SAME = 1e-6
"""The largest relative difference of principal moments that count as equal."""


FLAT = 0.4
"""The largest thickness of a thin disc, relative to its radius."""


def equivalent_shape(mass: float, inertia: Array, link: Array | None, least: float) -> dict[str, Any]:
    """Return the homogeneous solid with this mass and inertia, as a part of the page.

    With principal moments A, B, C a box has the sides ``a^2 = 6 (B + C - A)/m``; where A = B, a cylinder has
    ``r^2 = 2 C/m`` and ``h^2 = 12 (A - C/2)/m`` [Goldstein 2002, sec. 5]. A body with only one moment moves in a
    plane: it is a rod along its link, ``l^2 = 12 C/m``, or a disc.

    Args:
        mass: the mass. A particle is a ball; a body with inertia but no mass, such as a flywheel, is a disc.
        inertia: the inertia tensor about the centre of mass, shape (3, 3).
        link: the direction from the joint to the centre of mass, or of the longest arm, if there is one.
        least: the smallest visible length.
    """
    moments, axes = np.linalg.eigh(inertia)
    if mass <= 0 < moments[-1]:
        return _rod(axes[:, 2], least, 5 * least)
    if mass <= 0 or moments[-1] <= 0:
        return {"kind": "ellipsoid", "size": [1.5 * least] * 3, "at": [0.0] * 3}
    if moments[-1] > SAME * mass * least**2 and np.all(np.abs(moments[:2]) < SAME * moments[-1]):
        return _planar(mass, moments[-1], axes[:, 2], link, least)
    if np.ptp(moments) < SAME * moments[-1]:
        return {
            "kind": "ellipsoid",
            "size": [max(least, (2.5 * moments[0] / mass) ** 0.5)] * 3,
            "at": [0.0] * 3,
        }
    for k, (i, j) in enumerate(((1, 2), (0, 2), (0, 1))):
        if abs(moments[i] - moments[j]) < SAME * moments[-1]:
            return _cylinder(mass, moments[i], moments[k], axes[:, k], least)
    sides = np.sqrt(np.maximum(6 * (moments.sum() - 2 * moments) / mass, 0))
    return _box(np.maximum(sides, least), axes)


def _planar(mass: float, moment: float, normal: Array, link: Array | None, least: float) -> dict[str, Any]:
    """Return the rod or the disc of a body that moves in a plane.

    Args:
        mass: the mass.
        moment: the only moment of inertia.
        normal: its axis, shape (3,).
        link: the direction of the link, if there is one.
        least: the smallest visible length.
    """
    in_plane = None if link is None else link - (link @ normal) * normal
    if in_plane is None or np.linalg.norm(in_plane) < SAME:
        radius = (2 * moment / mass) ** 0.5
        return _rod(normal, _thickness(radius, least), radius)
    along = in_plane / np.linalg.norm(in_plane)
    length = max(least, (12 * moment / mass) ** 0.5)
    axes = np.column_stack([along, np.cross(normal, along), normal])
    return _box(np.array([length, least, least]), axes)


def _cylinder(mass: float, across: float, along: float, axis: Array, least: float) -> dict[str, Any]:
    """Return the cylinder with two equal principal moments.

    Args:
        mass: the mass.
        across: the two equal principal moments.
        along: the moment about the axis.
        axis: the axis, shape (3,).
        least: the smallest visible length.
    """
    height = float(np.sqrt(max(12 * (across - along / 2) / mass, 0)))
    radius = max(least / 2, (2 * max(along, 0) / mass) ** 0.5)
    return _rod(axis, max(height, _thickness(radius, least)), radius)


def _thickness(radius: float, least: float) -> float:
    """Return the drawn thickness of a disc that is too thin to be seen; it is still that of a disc."""
    return min(least, FLAT * radius)


def _rod(axis: Array, length: float, radius: float) -> dict[str, Any]:
    half = axis * length / 2
    return {"kind": "rod", "radius": float(radius), "from": (-half).tolist(), "to": half.tolist()}


def _box(sides: Array, axes: Array) -> dict[str, Any]:
    """Return a box whose axes are the columns of a matrix, made right-handed."""
    x, y = axes[:, 0], axes[:, 1]
    rotation = np.column_stack([x, y, np.cross(x, y)])
    return {"kind": "box", "size": sides.tolist(), "at": [0.0] * 3, "rotation": rotation.tolist()}
