"""Linear equations of any rank: the least-squares solution of minimum norm, the pseudoinverse, and the null space."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

__all__ = ["RANK", "inverse_and_kernel", "least_norm", "least_norm_many", "row_sizes"]

Array = NDArray[np.float64]

RANK = 1e-10
"""The ratio to the largest singular value below which one counts as zero."""


def least_norm(A: Array, b: Array) -> tuple[Array, Array]:
    """Return the shortest x with the least ``|A x - b|``, shape (n,), and a basis of the null space of A as columns.

    Rows are scaled by their largest entries before the rank is determined: they may have different units.
    """
    inverse, kernel = inverse_and_kernel(A)
    return inverse @ b, kernel


def inverse_and_kernel(A: Array) -> tuple[Array, Array]:
    """Return the pseudoinverse A^+, (columns, rows), and a basis of the null space of A as columns.

    Both are of one decomposition, and so of one rank, of A with scaled rows, as in `least_norm`.
    """
    rows, columns = A.shape
    if rows == 0 or columns == 0:
        return np.zeros((columns, rows)), np.eye(columns)
    size = row_sizes(A)
    U, s, Vt = np.linalg.svd(A / size)
    rank = int(np.sum(s > RANK * s.max(initial=0.0)))
    inverse: Array = Vt[:rank].T @ (U[:, :rank].T / s[:rank, None] / size[:, 0])
    return inverse, Vt[rank:].T


def least_norm_many(A: Array, b: Array) -> tuple[Array, Array]:
    """Return the least-norm solutions of many linear systems, and how far each unknown is determined, 1 if it is.

    Args:
        A: the matrices, shape (N, rows, columns).
        b: the right sides, shape (N, rows).
    """
    count, rows, columns = A.shape
    if columns == 0 or rows == 0:
        return np.zeros((count, columns)), np.zeros((count, columns))
    if count == 1:
        x, kernel = least_norm(A[0], b[0])
        return x[None], 1 - np.sum(kernel**2, axis=1)[None]
    size = row_sizes(A)
    inverse = np.linalg.pinv(A / size, rcond=RANK)
    x = np.einsum("kij,kj->ki", inverse, b / size[:, :, 0])
    determined = np.einsum("kij,kji->ki", inverse, A / size)
    return x, determined


def row_sizes(A: Array) -> Array:
    """Return the largest entry of each row as a column; for rows that are zero up to rounding, that of all rows."""
    rows = np.abs(A).max(axis=-1, keepdims=True)
    largest = rows.max(axis=-2, keepdims=True)
    sizes: Array = np.where(rows > RANK * largest, rows, np.where(largest > 0, largest, 1.0))
    return sizes
