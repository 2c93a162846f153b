"""Combinations of the rows of a matrix that nearly vanish."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

__all__ = ["vanishing_combinations"]

Array = NDArray[np.float64]

SHARE = 1e-3
"""The ratio to the largest coefficient of a combination below which a row does not belong to it."""


def vanishing_combinations(A: Array, near: float) -> list[Array]:
    """Return combinations of rows that nearly vanish, each with as few rows as elimination finds.

    The left singular vectors of small singular values span them. In each combination one row, rather a late one, has no
    share in the others, so that independent dependences are separated.

    Args:
        A: the matrix; its rows are in comparable units.
        near: the ratio to the largest singular value below which one is small.

    >>> [combination.round(3).tolist() for combination in vanishing_combinations(np.array([[1.0], [2.0]]), 1e-9)]
    [[-0.894, 0.447]]
    """
    U, s, _ = np.linalg.svd(A)
    basis = U[:, int(np.sum(s > near * s.max(initial=0.0))) :]
    for c in range(basis.shape[1]):
        sizes = np.abs(basis[:, c:]).max(axis=1)
        row = int(np.flatnonzero(sizes >= SHARE * sizes.max())[-1])
        pivot = c + int(np.argmax(np.abs(basis[row, c:])))
        basis[:, [c, pivot]] = basis[:, [pivot, c]]
        others = np.arange(basis.shape[1]) != c
        basis[:, others] -= np.outer(basis[:, c], basis[row, others] / basis[row, c])
        basis[:, c] *= np.sign(basis[row, c]) / np.linalg.norm(basis[:, c])
    return [np.where(np.abs(y) > SHARE * np.abs(y).max(initial=0.0), y, 0.0) for y in basis.T]
