"""Poses of frames and places of points along a motion."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from symbody.errors import ViewError
from symbody.geometry import Frame, Point, Vector
from symbody.symbolic import Expr
from symbody.symbolic.given.arguments import brief
from symbody.view.drawable_motion import DrawableMotion

Array = NDArray[np.float64]


def values(motion: DrawableMotion, expressions: Sequence[Expr]) -> Array:
    """Return the values of expressions along a motion, shape (expressions, N).

    Raises:
        ViewError: the motion has no instants, or a value is not finite.
    """
    if len(motion.t) == 0:
        raise ViewError(
            "view: the motion has no instants, so there is nothing to draw; expected at least one"
        )
    if not expressions:
        return np.empty((0, len(motion.t)))
    rows = np.asarray(motion.evaluate(expressions), dtype=np.float64)
    rows = np.broadcast_to(rows, (len(expressions), len(motion.t)))
    if not np.isfinite(rows).all():
        k, i = np.argwhere(~np.isfinite(rows))[0]
        raise ViewError(
            f"view: {brief(expressions[k])} is {rows[k, i]} at t = {motion.t[i]:g}; expected finite numbers: "
            "correct the parameters, or draw the motion up to there"
        )
    return rows


def poses(motion: DrawableMotion, frames: Sequence[Frame]) -> Array:
    """Return origins and unit quaternions (x, y, z, w) of frames in the root frame, shape (frames, N, 7).

    Matrices that are not rotations, as with natural coordinates that drift, are replaced by the nearest rotations.
    """
    entries: list[Expr] = []
    for frame in frames:
        rows, origin = frame.pose
        entries += [*rows[0], *rows[1], *rows[2], *origin]
    table = values(motion, entries).reshape(len(frames), 12, len(motion.t)).transpose(0, 2, 1)
    quaternions = [_quaternions(track[:, :9].reshape(-1, 3, 3)) for track in table]
    return np.concatenate([table[:, :, 9:], np.array(quaternions).reshape(*table.shape[:2], 4)], axis=2)


def _quaternions(matrices: Array) -> Array:
    """Return the quaternions of the nearest rotations, with continuous signs."""
    u, _, vt = np.linalg.svd(matrices)
    u[:, :, 2] *= np.linalg.det(u @ vt)[:, None]
    quaternions = Rotation.from_matrix(u @ vt).as_quat()
    turns = np.where(np.sum(quaternions[1:] * quaternions[:-1], axis=1) < 0, -1.0, 1.0)
    signs = np.cumprod(np.concatenate([[1.0], turns]))
    return np.asarray(quaternions * signs[:, None])


def paths(motion: DrawableMotion, points: Sequence[Point]) -> Array:
    """Return the places of points in the root frame, shape (points, N, 3)."""
    entries = [x for point in points for x in point.projected(point.frame.ancestor).coordinates]
    return values(motion, entries).reshape(len(points), 3, len(motion.t)).transpose(0, 2, 1)


def arrows(motion: DrawableMotion, vectors: Sequence[Vector]) -> Array:
    """Return the components of vectors in the root frame, shape (vectors, N, 3)."""
    entries = [x for vector in vectors for x in vector.projected(vector.frame.ancestor).components]
    return values(motion, entries).reshape(len(vectors), 3, len(motion.t)).transpose(0, 2, 1)


def constants(motion: DrawableMotion, expressions: Sequence[Expr]) -> Array:
    """Return the values of expressions of parameters."""
    return values(motion, expressions)[:, 0]


def fixed_paths(track: Array, places: Array) -> Array:
    """Return the paths of points that are fixed in a frame, given its poses: shape (points, N, 3)."""
    turn = Rotation.from_quat(track[:, 3:])
    return np.array([track[:, :3] + turn.apply(place) for place in places]).reshape(-1, len(track), 3)


def relative_path(track: Array, path: Array) -> Array:
    """Return the path of a point in a moving frame, given the poses of that frame: shape (N, 3)."""
    return np.asarray(Rotation.from_quat(track[:, 3:]).inv().apply(path - track[:, :3]))


def rounded(track: Array) -> list[float]:
    """Return a track as numbers with seven digits, more than a screen shows."""
    return [float(f"{x:.7g}") for x in track.ravel()]
