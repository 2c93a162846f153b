"""Singular positions that a motion passes: where its constraints become dependent between two instants."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .model import Model

__all__ = ["singular_passages"]

Array = NDArray[np.float64]

NEAR = 0.02
"""The part of the largest singular value below which the least one of a motion is taken for zero."""
AGREEMENT = 0.6
"""Intervals between instants by which the places may differ at which the smallest singular value vanishes, as the two
instants before the least and the two behind it say."""


def singular_passages(model: Model, parameters: Array, t: Array, states: Array) -> Array:
    """Return the instants next to which the constraints of a motion become dependent.

    The smallest singular value of ``phi_q L^-T``, with ``M = L L^T``, falls and rises in proportion to the distance
    from a singular position: it is found where straight lines through the values on both sides meet zero at one place,
    which takes instants that are close to each other, and where it is very small.

    Args:
        model: what moves.
        parameters: the values of its parameters, and behind them those of the stabilisation, if there is one.
        t: the instants, N of them, in s.
        states: coordinates and speeds, a row for each.
    """
    if not model.constraints or len(t) < 5:
        return np.empty(0)
    ratio = _smallest(model, parameters, t, states)
    before, after = _falls(ratio), _falls(ratio[::-1])[::-1]
    inner = slice(2, -2)
    # Both in intervals from the instant in the middle: where the values before it fall to zero, and those behind it.
    left, right = -1 + ratio[1:-3] / before[1:-3], 1 - ratio[3:-1] / after[3:-1]
    is_least = (ratio[inner] <= ratio[1:-3]) & (ratio[inner] <= ratio[3:-1])
    near = (
        (np.abs(left) < 1 + AGREEMENT) & (np.abs(right) < 1 + AGREEMENT) & (np.abs(left - right) < AGREEMENT)
    )
    found: Array = t[inner][is_least & (near | (ratio[inner] < NEAR))]
    return found


def _falls(ratio: Array) -> Array:
    """Return by how much each value is less than the one before it; NaN where it isn't."""
    falls = np.full(len(ratio), np.nan)
    falls[1:] = ratio[:-1] - ratio[1:]
    return np.where(falls > 0, falls, np.nan)


def _smallest(model: Model, parameters: Array, t: Array, states: Array) -> Array:
    """Return the smallest singular value of the independent constraints, relative to the largest; NaN if not finite."""
    n, m, rank = len(model.speeds), len(model.constraints), model.independent_constraints
    names = (*model.parameters, *model.damping)
    expressions = [*model.equations.mass_matrix.entries, *model.equations.constraint_jacobian.entries]
    columns = states[:, : len(model.state)].T
    with np.errstate(all="ignore"):
        values = np.asarray(model.function(expressions, names)(t, *columns, *parameters[: len(names)]))
    M, J = values[: n * n].T.reshape(-1, n, n), values[n * n :].T.reshape(-1, m, n)
    is_fit = np.isfinite(values).all(axis=0) & (
        np.linalg.eigvalsh(np.where(np.isfinite(M), M, 0.0))[:, 0] > 0
    )
    smallest = np.full(len(t), np.nan)
    if is_fit.any() and rank:
        in_metric = np.linalg.solve(np.linalg.cholesky(M[is_fit]), np.swapaxes(J[is_fit], 1, 2))
        longest = np.linalg.norm(in_metric, axis=1).max(axis=0)
        s = np.linalg.svd(in_metric / np.where(longest > 0, longest, 1.0), compute_uv=False)
        smallest[is_fit] = s[:, rank - 1] / s[:, 0]
    return smallest
