"""Singular positions that a motion passes: its constraints become dependent between two steps."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping

import numpy as np
from numpy.typing import NDArray

from symbody.simulation.model.model import Model
from symbody.symbolic import Expr

from .constraint_directions import masses_and_jacobians
from .zeros_along import course_of, zeros_along

__all__ = ["singular_passages"]

Array = NDArray[np.float64]

AT_ONCE = 2**12
"""The number of matrices that are processed at once, which bounds the memory."""


def singular_passages(model: Model, parameters: Mapping[Expr, float], trail: Array) -> Array:
    """Return the instants, in s, at which the constraints of a motion are dependent, or nearly so.

    There the smallest singular value of ``D phi_q L^-T`` has a minimum next to zero. ``L L^T`` is the mean of the
    mass matrix along the motion, since a metric that varies makes no constraints dependent. D scales each row to the
    length of its largest entry, relative to the largest value of that entry along the motion: rows vanish only where
    all of their entries do. A motion that stays at such positions for a while counts as one passage.

    Args:
        model: the model.
        parameters: the values of its parameters, including those of Baumgarte's stabilisation.
        trail: the instant, the coordinates and the speeds at the ends of steps, one row for each.
    """
    if len(trail) < 2 or not model.constraints or not model.independent_constraints:
        return np.empty(0)
    p = np.array([parameters[name] for name in (*model.parameters, *model.damping)])
    course = course_of(model, p, trail)
    if course is None:
        return np.empty(0)
    t, way = course.instants, course.states

    def along(times: Array) -> Iterator[tuple[Array, Array]]:
        for part in np.array_split(times, 1 + len(times) // AT_ONCE):
            yield masses_and_jacobians(model, p, part, way(part))

    scaled = _scaling(along(t))
    if scaled is None:
        return np.empty(0)

    def smallest(times: Array) -> Array:
        return np.concatenate([_smallest(scaled(J), model.independent_constraints) for _, J in along(times)])

    return zeros_along(smallest, t)


def _scaling(parts: Iterable[tuple[Array, Array]]) -> Callable[[Array], Array] | None:
    """Return the scaling of Jacobians of the constraints, (k, m, n); None without a mean mass matrix.

    Args:
        parts: mass matrices and Jacobians of the constraints along the motion.
    """
    total, largest = 0.0, 0.0
    for M, slopes in parts:
        total = total + M[np.isfinite(M).all(axis=(1, 2))].sum(axis=0)
        largest = np.maximum(largest, np.abs(np.where(np.isfinite(slopes), slopes, 0.0)).max(axis=0))
    if not np.linalg.eigvalsh(total)[0] > 0:
        return None
    to_metric = np.linalg.inv(np.linalg.cholesky(total)).T
    entries = np.where(largest == 0, 1.0, largest)

    def scaled(some: Array) -> Array:
        in_metric = some @ to_metric
        lengths = np.linalg.norm(in_metric, axis=2)
        shares = (np.abs(some) / entries).max(axis=2)
        factors: Array = shares / np.where(lengths > 0, lengths, 1.0)
        result: Array = in_metric * factors[:, :, None]
        return result

    return scaled


def _smallest(slopes: Array, rank: int) -> Array:
    """Return the smallest singular value of the independent constraints, NaN if a Jacobian is not finite."""
    is_fit = np.isfinite(slopes).all(axis=(1, 2))
    smallest = np.full(len(slopes), np.nan)
    smallest[is_fit] = np.linalg.svd(slopes[is_fit], compute_uv=False)[:, rank - 1]
    return smallest
