"""Branches of eigenvalues over a parameter: which eigenvalue at one value continues which at the next one.

With the eigenvectors V and V' at two values, ``P = O * (O^-1)^T`` of ``O = V^-1 V'``, entry by entry, has rows and
columns of sum 1, and depends neither on the units of the states nor on the scale of the vectors: it is a permutation if
the vectors are the same, as the modal assurance criterion of orthogonal modes [Allemang 2003]. Eigenvalues are
assigned by P and by their distance [Kuhn 1955]; an interval in which P does not decide is halved.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

__all__ = ["likeness", "tracked"]

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]

_SURE = 0.4
"""The deviation of an entry of P from 1 up to which it decides."""
_HALVINGS = 12
"""How often an interval is halved: branches that meet have no common vectors there, however near one looks."""
_SAME = 1e-6
"""The distance, relative to the largest eigenvalue, up to which eigenvalues are the same, so that none is wrong."""

Eigenvectors = Callable[[Array], tuple[Complex, Complex]]


def tracked(eigenvectors: Eigenvectors, values: Array) -> tuple[Array, Complex]:
    """Return the values of the parameter, with those that were needed between, and the branches, (N, n).

    Args:
        eigenvectors: the eigenvalues at N values, and their vectors.
        values: the values of the parameter, increasing.
    """
    found, vectors = eigenvectors(values)
    limit = np.diff(values).min() / 2**_HALVINGS
    steps, unsure = _assignments(_Ends(found[:-1], vectors[:-1]), _Ends(found[1:], vectors[1:]))
    while True:
        k = np.flatnonzero(unsure & (np.diff(values) > 1.5 * limit))
        if not len(k):
            return values, _followed(found, steps)
        middle = (values[k] + values[k + 1]) / 2
        between = _Ends(*eigenvectors(middle))
        first = _assignments(_Ends(found[k], vectors[k]), between)
        second = _assignments(between, _Ends(found[k + 1], vectors[k + 1]))
        steps[k], unsure[k] = first
        steps, unsure = (
            np.insert(old, k + 1, new, axis=0) for old, new in zip((steps, unsure), second, strict=True)
        )
        values = np.insert(values, k + 1, middle)
        found = np.insert(found, k + 1, between.found, axis=0)
        vectors = np.insert(vectors, k + 1, between.vectors, axis=0)


class _Ends(NamedTuple):
    """The eigenvalues and their vectors at one end of each of some intervals."""

    found: Complex
    vectors: Complex


def _followed(found: Complex, steps: NDArray[np.intp]) -> Complex:
    """Return the eigenvalues in the order of their branches, that at the first value by size."""
    scale = np.abs(found).max() or 1.0
    order = np.lexsort((found[0].imag, np.abs(found[0].imag), -np.round(found[0].real / scale, 9)))
    branches = np.empty_like(found)
    branches[0] = found[0, order]
    for k, step in enumerate(steps):
        order = step[order]
        branches[k + 1] = found[k + 1, order]
    return branches


def _assignments(start: _Ends, end: _Ends) -> tuple[NDArray[np.intp], NDArray[np.bool_]]:
    """Return which eigenvalue at the end of N intervals follows each, (N, n), and whether that is unsure, (N,)."""
    from scipy.optimize import linear_sum_assignment  # noqa: PLC0415 - slow to load

    before, after = start.found, end.found
    n = before.shape[1]
    P = likeness(start.vectors, end.vectors)
    # most rows are plain: the largest entry of each row of P is near 1, and no two are in one column
    best = np.argmax(np.abs(P), axis=2)
    chosen = np.take_along_axis(P, best[:, :, None], axis=2)[:, :, 0]
    plain = (np.abs(chosen - 1) < _SURE).all(axis=1) & (np.sort(best, axis=1) == np.arange(n)).all(axis=1)
    unsure = np.zeros(len(best), dtype=bool)
    for k in np.flatnonzero(~plain):
        scale = max(float(np.abs([before[k], after[k]]).max()), np.finfo(float).tiny)
        distance = np.abs(before[k][:, None] - after[k]) / scale
        tie = np.abs(_ranks(before[k], scale)[:, None] - _ranks(after[k], scale)) / n
        _, best[k] = linear_sum_assignment(1 - np.clip(np.abs(P[k]), 0, 1) + distance + 1e-6 * tie)
        doubtful = np.flatnonzero(np.abs(P[k, np.arange(n), best[k]] - 1) >= _SURE)
        same = _SAME * scale
        unsure[k] = any(
            not any(
                j != i
                and abs(before[k, i] - before[k, j]) <= same
                and abs(after[k, best[k, i]] - after[k, best[k, j]]) <= same
                for j in doubtful
            )
            for i in doubtful
        )
        if unsure[k]:  # where branches meet, vectors don't distinguish them, but distances do
            _, best[k] = linear_sum_assignment(distance + 1e-9 * tie)
    return best, unsure


def _ranks(found: Complex, scale: float) -> NDArray[np.intp]:
    """Return the ranks of eigenvalues by imaginary and real parts: real ones that meet go up and down in this order."""
    return np.argsort(np.lexsort((found.real, np.round(found.imag / scale, 9))))


def likeness(before: Complex, after: Complex) -> Complex:
    """Return P of the vectors at both ends of N intervals, (N, n, n)."""
    try:
        overlap, inverse = np.linalg.solve(before, after), np.linalg.solve(after, before)
    except np.linalg.LinAlgError:
        overlap, inverse = np.linalg.pinv(before) @ after, np.linalg.pinv(after) @ before
    product = overlap * inverse.swapaxes(-1, -2)
    return product if np.isfinite(product).all() else np.nan_to_num(product)
