"""Linear systems of many motions at once, ``A x = b`` with few equations: the rows of A are made orthogonal.

By the modified Gram-Schmidt process [Bjorck, Numerical Methods for Least Squares Problems, 1996, sec. 2.4], in which
each row is removed from those after it. The numbers of all motions are columns, the last axis of each array, so that
each operation is done for all motions at once. No arithmetic crosses motions.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .least_norm import RANK

__all__ = ["added", "least_ratios", "shortest_solutions", "within_kernels"]

Array = NDArray[np.float64]


def added(terms: Array, axis: int) -> Array:
    """Return sums along an axis other than the last, in the same order of the terms for one motion and for many."""
    if terms.shape[-1] == 1 and terms.shape[axis]:  # NumPy would add contiguous terms in pairs
        return np.asarray(np.take(np.add.accumulate(terms, axis=axis), -1, axis=axis))
    return np.asarray(terms.sum(axis=axis))


def shortest_solutions(A: Array, b: Array, rank: float = RANK) -> Array:
    """Return the shortest solutions of k linear systems, shape (n, k); equations that follow from others are left out.

    Args:
        A: the matrices, shape (m, n, k).
        b: the right sides, shape (m, k).
        rank: the part of a row below which it counts as a combination of those before it.

    >>> A, b = np.array([[[3.0, 1.0], [4.0, 1.0]]]), np.array([[5.0, 1.0]])
    >>> shortest_solutions(A, b).T
    array([[0.6, 0.8],
           [0.5, 0.5]])
    """
    rows, sides = _orthogonal(A, b[:, None], rank)
    x = np.zeros(A.shape[1:])
    for row, side in zip(rows[::-1], sides[::-1], strict=True):
        x += row * (side[0] - added(row * x, 0))
    return x


def within_kernels(A: Array, x: Array) -> Array:
    """Return the parts of k vectors (n, k) that are orthogonal to all rows of the matrices (m, n, k)."""
    rows, _ = _orthogonal(A, np.empty((len(A), 0, A.shape[-1])), RANK)
    for row in rows:
        x = x - row * added(row * x, 0)
    return x


def least_ratios(A: Array) -> Array:
    """Return lower bounds on the ratios of the smallest to the largest singular value of k matrices, shape (k,).

    With ``A = L Q`` and orthonormal rows of Q, it is at least ``1 / (|L| |L^-1|)`` in the Frobenius norm. Without
    certainty the bound is zero.
    """
    m, _, count = A.shape
    ones = np.repeat(np.eye(m)[:, :, None], count, axis=2)
    rows, inverse = _orthogonal(A, ones, RANK)
    size = added(added(A * A, 0), 0) * added(added(inverse * inverse, 0), 0)
    is_certain = (rows != 0).any(axis=1).all(axis=0) & np.isfinite(size) & (size > 0)
    return np.where(is_certain, 1 / np.sqrt(np.where(is_certain, size, 1.0)), 0.0)


def _orthogonal(A: Array, sides: Array, rank: float) -> tuple[Array, Array]:
    """Return equivalent equations with orthonormal rows, those that follow from others as zeros.

    Args:
        A: the rows, shape (m, n, k).
        sides: right sides of the equations, shape (m, any, k).
        rank: see `shortest_solutions`.
    """
    rows, sides = A.copy(), sides.copy()
    least = rank * np.sqrt(added(A * A, 1))
    for i in range(len(rows)):
        length = np.sqrt(added(rows[i] * rows[i], 0))
        is_kept = length > least[i]
        factor = np.where(is_kept, 1 / np.where(is_kept, length, 1.0), 0.0)
        rows[i] *= factor
        sides[i] *= factor
        if i + 1 < len(rows):
            shares = added(rows[i + 1 :] * rows[i], 1)[:, None]
            rows[i + 1 :] -= shares * rows[i]
            sides[i + 1 :] -= shares * sides[i]
    return rows, sides
