"""Whether an argument is a finite real number."""

from __future__ import annotations

from math import isfinite
from numbers import Real

__all__ = ["is_real"]


def is_real(value: object) -> bool:
    """Return whether a value is a finite number, and no bool.

    >>> is_real(1), is_real(2.5), is_real(True), is_real("1"), is_real(float("nan"))
    (True, True, False, False, False)
    """
    return not isinstance(value, bool) and isinstance(value, Real) and isfinite(value)
