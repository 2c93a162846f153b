"""Integers of many digits, read from text."""

from __future__ import annotations

__all__ = ["MOST_DIGITS", "integer_of"]

MOST_DIGITS = 1_000_000
"""Integers of more digits are not read."""
_DIRECT = 4000
"""Digits that Python converts without being told to."""


def integer_of(digits: str) -> int:
    """Return the integer with these decimal digits; many digits are converted half by half.

    >>> integer_of("1" + "0" * 5000) == 10**5000
    True
    """
    if len(digits) <= _DIRECT:
        return int(digits)
    behind = len(digits) // 2
    power: int = 10**behind
    return integer_of(digits[:-behind]) * power + integer_of(digits[-behind:])
