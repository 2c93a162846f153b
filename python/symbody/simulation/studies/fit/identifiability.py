"""Which unknowns the measurements determine: covariances, and directions without information."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

__all__ = ["Information", "information"]

Array = NDArray[np.float64]

_DEPENDENT = 1e-6
"""The smallest ratio of singular values of a Jacobian with columns of length 1 that is more than its errors."""

_PART = 0.1
"""The least component of an unknown in a direction that nothing determines, relative to the largest one."""


@dataclass(frozen=True, eq=False)
class Information:
    """What a Jacobian J says of n unknowns.

    Attributes:
        covariance: ``(J^T J)^-1``, shape (n, n); infinite on the diagonal for unknowns that are not determined.
        groups: the unknowns that each direction without information contains.
    """

    covariance: Array
    groups: tuple[tuple[int, ...], ...]


def information(jacobian: Array) -> Information:
    """Return the covariance of the unknowns for residuals of unit variance, by singular values.

    Columns are scaled to length 1 first, so that units do not matter.
    """
    lengths = np.linalg.norm(jacobian, axis=0)
    scale = np.where(lengths > 0, lengths, 1.0)
    _, s, rows = np.linalg.svd(jacobian / scale, full_matrices=True)
    s = np.append(s, np.zeros(len(rows) - len(s)))
    is_known = s > _DEPENDENT * max(s.max(initial=0.0), 1.0)
    vectors = rows[is_known].T / s[is_known]
    covariance = (vectors @ vectors.T) / np.outer(scale, scale)
    groups = _groups(rows[~is_known])
    lost = sorted({k for group in groups for k in group})
    covariance[lost, lost] = np.inf
    return Information(covariance, groups)


def _groups(directions: Sequence[Array] | Array) -> tuple[tuple[int, ...], ...]:
    """Return the unknowns in each direction of a null space, after reduction to as few unknowns as possible."""
    basis, found = np.array(directions), []
    for row in range(len(basis)):
        rest = np.abs(basis[row:]).max(axis=0)
        pivot = int(rest.argmax())
        best = row + int(np.abs(basis[row:, pivot]).argmax())
        basis[[row, best]] = basis[[best, row]]
        basis[row] /= basis[row, pivot]
        for other in range(len(basis)):
            if other != row:
                basis[other] -= basis[other, pivot] * basis[row]
    for direction in basis:
        size = np.abs(direction)
        found.append(tuple(np.flatnonzero(size > _PART * size.max()).tolist()))
    return tuple(found)
