"""Whether pencils are regular: whether E has an inverse, and whether det(A0 - s E) vanishes for all s."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from symbody.errors import ModelError
from symbody.symbolic import Expr
from symbody.symbolic.given.arguments import brief

__all__ = ["check_regular", "rates_matrix"]

Array = NDArray[np.float64]

_SINGULAR = 1e-13
_SHIFTS = (0.6180339887498949, 1.3247179572447460, 1.8392867552141612)
"""Places at which a regular pencil has its rank: an eigenvalue would have to be at all of them."""


def rates_matrix(E: Array, A0: Array) -> Array | None:
    """Return A of ``x' = A x``, ``E^-1 A0``, or None if E has no inverse.

    Args:
        E: (*S, n, n).
        A0: (*S, n, n).
    """
    scales = np.abs(E).max(axis=-1, keepdims=True, initial=0.0)
    if (scales == 0).any():
        return None
    rows = E / scales
    columns = np.abs(rows).max(axis=-2, keepdims=True, initial=0.0)
    if (columns == 0).any():
        return None
    if E.shape[-1] and (np.linalg.cond(rows / columns) > 1 / _SINGULAR).any():
        return None
    return np.asarray(np.linalg.solve(E, A0))


def check_regular(E: Array, A0: Array, states: Sequence[Expr], where: str) -> None:
    """Check that ``A0 - s E`` has an inverse for some s.

    Args:
        E: n x n.
        A0: n x n.
        states: the names of the states.
        where: the function that the user called, for messages.

    Raises:
        ModelError: it has none for any s.
    """
    size = np.abs(A0).max(initial=0.0) / (np.abs(E).max(initial=0.0) or 1.0) or 1.0
    free = np.zeros(len(A0))
    for shift in _SHIFTS:
        shifted = A0 - shift * size * E
        scale = np.abs(shifted).max(axis=1, keepdims=True)
        _, s, vh = np.linalg.svd(shifted / np.where(scale > 0, scale, 1.0))
        if s[-1] > _SINGULAR * s[0]:
            return
        free = vh[-1]
    moved = [
        str(name)
        for name, share in zip(states, np.abs(free), strict=True)
        if share > 1e-6 * np.abs(free).max()
    ]
    raise ModelError(
        f"{where}: the pencil of E x' = A0 x is singular: nothing determines a motion of {brief(', '.join(moved))}, "
        "which has neither mass, damping nor stiffness; give it one of them, or leave the coordinate out"
    )
