"""Integers of many digits: their text, and the number that a text is."""

from __future__ import annotations

from symbody.symbolic import Expr

__all__ = ["MOST_BITS", "MOST_DIGITS", "integer_of", "number_text", "shown_number"]

MOST_DIGITS = 1_000_000
"""Integers of more digits are not read; powers of more are not computed."""
_DIRECT = 4000
"""Digits that Python converts without being told to."""
MOST_BITS = 3 * _DIRECT
"""Bits of integers that have fewer digits than these."""
_SHOWN = 10_000
_ENDS = 100
"""Maple's ``elisiondigitsthreshold``, and the digits that it shows before and behind what it leaves out."""


def integer_of(digits: str) -> int:
    """Return the integer that digits are, half by half where there are many.

    >>> integer_of("1" + "0" * 5000) == 10**5000
    True
    """
    if len(digits) <= _DIRECT:
        return int(digits)
    behind = len(digits) // 2
    power: int = 10**behind
    return integer_of(digits[:-behind]) * power + integer_of(digits[-behind:])


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
