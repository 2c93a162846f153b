"""Integers of many digits, printed."""

from __future__ import annotations

from symbody.symbolic import Expr

__all__ = ["MOST_BITS", "number_text", "shown_number"]

_DIRECT = 4000
"""Digits that Python converts without being told to."""
MOST_BITS = 3 * _DIRECT
"""Bits of integers that have fewer digits than these."""
_SHOWN = 10_000
_ENDS = 100
"""Maple's ``elisiondigitsthreshold``, and the digits that it shows before and behind what it leaves out."""


def number_text(value: Expr) -> str:
    """Return the complete text of an exact number."""
    numerator, denominator = value.ratio
    if max(numerator.bit_length(), denominator.bit_length()) > MOST_BITS:
        return str(value)
    return str(numerator) if denominator == 1 else f"{numerator}/{denominator}"


def shown_number(value: Expr) -> str:
    """Return the text of an exact number as Maple shows it: of very many digits, the first and the last ones.

    >>> from symbody import number
    >>> shown_number(number(2) ** 100)
    '1267650600228229401496703205376'
    >>> shown_number(number(10) ** 20_000)[98:120]
    '00[...19801 digits...]'
    """
    return "/".join(map(_cut, number_text(value).split("/")))


def _cut(digits: str) -> str:
    left_out = len(digits.lstrip("-")) - 2 * _ENDS
    if left_out <= _SHOWN - 2 * _ENDS:
        return digits
    return f"{digits[: len(digits) - left_out - _ENDS]}[...{left_out} digits...]{digits[-_ENDS:]}"
