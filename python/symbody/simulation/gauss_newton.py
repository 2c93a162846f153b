"""Nonlinear equations by damped Gauss-Newton steps, which know no rank: Levenberg and Marquardt's method."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

__all__ = ["RANK", "Linearization", "gauss_newton", "least_norm", "row_sizes"]

Array = NDArray[np.float64]
Linearization = Callable[[Array], tuple[Array, Array]]
"""Returns values and their Jacobian; they may be infinite or not a number."""

RANK = 1e-10
"""The part of the largest singular value below which one counts as zero."""
_STEPS = 200
_LARGEST_DAMPING = 1e12


def gauss_newton(linearization: Linearization, start: Array) -> Array:
    """Return where equations hold as well as can be reached from a start.

    Steps of least norm, ``min |F + J d|^2 + mu |d|^2`` with ``mu`` proportional to ``|F|^2``: they converge
    quadratically near solutions, also where equations depend on each other or solutions aren't isolated [Yamashita &
    Fukushima 2001; Fan & Yuan 2005]. A step that improves nothing is damped more [More 1978].

    Args:
        linearization: the values and their Jacobian, scaled such that 1 is a large value.
        start: where to begin.
    """
    x, damping = np.array(start, dtype=np.float64), 1e-2
    F, J = linearization(x)
    for _ in range(_STEPS):
        error = float(F @ F)
        if not np.isfinite(error) or not np.isfinite(J).all() or error == 0 or damping > _LARGEST_DAMPING:
            break
        step = _damped_step(F, J, damping * error)
        expected = error - float(np.sum((F + J @ step) ** 2))
        if expected <= 1e-16 * error or np.abs(step).max() <= 1e-16 * np.abs(x).max():
            break
        F_next, J_next = linearization(x + step)
        gain = (error - float(F_next @ F_next)) / expected
        if gain > 1e-4:
            x, F, J = x + step, F_next, J_next
        damping = max(damping / 5, 1e-8) if gain > 0.75 else damping if gain > 0.25 else 4 * damping
    return x


def _damped_step(F: Array, J: Array, mu: float) -> Array:
    """Return ``d = -J^T (J J^T + mu 1)^-1 F``, by the singular values that aren't rounding errors."""
    U, s, Vt = np.linalg.svd(J, full_matrices=False)
    kept = s > 1e-13 * s.max(initial=0.0)
    s, U, Vt = s[kept], U[:, kept], Vt[kept]
    step: Array = -(Vt.T @ (s / (s * s + mu) * (U.T @ F)))
    return step


def least_norm(A: Array, b: Array) -> tuple[Array, Array]:
    """Return the shortest x of those with the least ``|A x - b|``, and a basis of what ``A`` takes to zero.

    Rows are scaled by `row_sizes` before the rank is decided: they may have different units.
    """
    rows, columns = A.shape
    if rows == 0 or columns == 0:
        return np.zeros(columns), np.eye(columns)
    size = row_sizes(A)
    U, s, Vt = np.linalg.svd(A / size)
    rank = int(np.sum(s > RANK * s.max(initial=0.0)))
    x: Array = Vt[:rank].T @ ((U[:, :rank].T @ (b / size[:, 0])) / s[:rank])
    return x, Vt[rank:].T


def row_sizes(A: Array) -> Array:
    """Return the largest entry of each row, as a column; that of all, for rows which are zero but for rounding."""
    rows = np.abs(A).max(axis=-1, keepdims=True)
    largest = rows.max(axis=-2, keepdims=True)
    sizes: Array = np.where(rows > RANK * largest, rows, np.where(largest > 0, largest, 1.0))
    return sizes
