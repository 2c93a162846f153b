"""The camera of a free-body diagram: along the normal of a plane part, and from one direction for any other part."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

__all__ = ["facing"]

Array = NDArray[np.float64]

FLAT = 1e-6
"""What is thinner than this part of its extent lies in a plane."""

CLEAR = 0.05
"""Points of action that are seen closer than this part of their largest distance lie on each other."""

TURNS = (0.0, 15.0, -15.0, 30.0, -30.0)
"""Turns of the camera about the vertical, in degrees, in the order of preference."""


def facing(
    view: Mapping[str, Any], places: Array, actions: Sequence[Sequence[Mapping[str, Any]]]
) -> dict[str, list[float]]:
    """Return a camera that faces the plane of a part and its forces, or one near the usual camera if there is none.

    The picture shows the true angles and lengths of the forces only along the normal. The part must stay in the plane
    at all instants: a mechanism may start in a plane and leave it.

    Args:
        view: the usual camera.
        places: points of the part, first at the instant that is drawn, then at others, shape (count, instants, 3).
        actions: the forces and moments at each of these instants.
    """
    normals = [_normal(places[:, k], each) for k, each in enumerate(actions)]
    normal = normals[0]
    if normal is None or any(other is None for other in normals):
        return _apart(view, actions)
    side = normal @ view["direction"]
    upwards = next(up for up in ([view["up"], *np.eye(3)[[1, 0]]]) if abs(normal @ up) < 0.9)
    up = upwards - (normal @ upwards) * normal
    return {
        "direction": (normal * (1 if side >= 0 else -1)).tolist(),
        "up": (up / np.linalg.norm(up)).tolist(),
    }


def _normal(places: Array, actions: Sequence[Mapping[str, Any]]) -> Array | None:
    """Return the normal of the plane of points and forces if all moments are along it; None if there is none."""
    forces = [each["vector"] for each in actions if not each["is_moment"]]
    moments = [each["vector"] for each in actions if each["is_moment"]]
    acting = [np.array(each["at"]) - places[0] for each in actions if not each["is_moment"]]
    lying = np.array([*(places - places[0]), *acting, *forces, np.zeros(3), np.zeros(3)])
    _, sizes, axes = np.linalg.svd(lying, full_matrices=False)
    normal = np.asarray(axes[2])
    if sizes[1] < FLAT * sizes[0] and moments:  # a line: the plane is across the moments
        normal = np.array(moments[0]) / np.linalg.norm(moments[0])
    is_across = np.abs(lying @ normal).max() <= FLAT * sizes[0]
    return normal if is_across and np.abs(np.cross(moments or [normal], normal)).max() <= FLAT else None


def _apart(view: Mapping[str, Any], actions: Sequence[Sequence[Mapping[str, Any]]]) -> dict[str, list[float]]:
    """Return the usual camera, turned about the vertical if points at which forces act lie on each other there."""
    direction, up = np.array(view["direction"], dtype=float), np.array(view["up"], dtype=float)
    gaps = np.concatenate([_gaps(each) for each in actions])
    gaps = gaps[np.linalg.norm(gaps, axis=1) > FLAT * float(view["radius"])]
    if not len(gaps):
        return {}

    def clearance(degrees: float) -> float:
        seen = Rotation.from_rotvec(np.radians(degrees) * up).apply(direction)
        return float(np.linalg.norm(np.cross(gaps, seen / np.linalg.norm(seen)), axis=1).min())

    if clearance(0.0) > CLEAR * float(np.linalg.norm(gaps, axis=1).max()):
        return {}
    best = max(TURNS, key=clearance)
    return {"direction": Rotation.from_rotvec(np.radians(best) * up).apply(direction).tolist()}


def _gaps(actions: Sequence[Mapping[str, Any]]) -> Array:
    """Return the distances between points of action, shape (pairs, 3)."""
    places = np.array([each["at"] for each in actions]).reshape(-1, 3)
    return np.asarray((places[:, None] - places[None])[np.triu_indices(len(places), 1)])
