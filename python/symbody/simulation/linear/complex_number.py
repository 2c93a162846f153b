"""One complex number, as an eigenvalue is given."""

from __future__ import annotations

import numpy as np

__all__ = ["complex_number"]


def complex_number(value: object) -> complex | None:
    """Return a finite complex number; None if the value is none.

    >>> complex_number(2 + 1j), complex_number("2"), complex_number(float("nan"))
    ((2+1j), None, None)
    """
    try:
        found = np.asarray(value)
        if found.ndim or found.dtype.kind not in "iufcO":
            return None
        number = complex(found.item())
    except (TypeError, ValueError, OverflowError):
        return None
    return number if np.isfinite(number) else None
