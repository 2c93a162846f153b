"""What is wrong with a row of numbers, in words."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from symbody.symbolic.given.arguments import described

__all__ = ["row_fault"]


def row_fault(given: ArrayLike | None, found: NDArray[np.float64] | None, *, increasing: bool = False) -> str:
    """Return what is wrong with a row of numbers; the empty text if nothing is.

    Args:
        given: what the user passed.
        found: the same as an array; None if there is none.
        increasing: whether they must be positive or zero and increase.

    >>> row_fault([], np.array([])), row_fault([2, 1], np.array([2.0, 1.0]), increasing=True)
    ('[] is empty', '[2, 1] does not increase')
    """
    if given is None:  # which NumPy takes for NaN
        return "None"
    shown = described(given).rpartition(" is ")[0]
    if found is not None and not found.ndim and found <= 0:
        return f"{shown} is not positive"
    if found is None or found.ndim != 1:
        return described(given)
    if not found.size:
        return f"{shown} is empty"
    if not np.isfinite(found).all():
        return f"{shown} holds {'NaN' if np.isnan(found).any() else 'an infinite number'}"
    if increasing and (np.diff(found) <= 0).any():
        return f"{shown} does not increase"
    return f"{shown} begins before 0" if increasing and found[0] < 0 else ""
