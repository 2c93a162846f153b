"""Numbers as Maple treats them: a decimal in a function or a root makes it a decimal."""

from __future__ import annotations

import math

from symbody.errors import WorksheetError
from symbody.symbolic import Expr, number
from symbody.worksheet.values.decimals import rounded

__all__ = ["as_float", "as_integer", "decimal", "of_bounded_length", "power", "quotient", "with_decimals"]

_LONG = 256
"""Bits of numerators and denominators up to which decimals are exact."""
_KEPT = 40
"""Digits that longer ones keep, many more than the doubles have that ``evalf`` gives."""

_ONE = number("1.0")
"""Makes a number a decimal; more digits than a double has are a fraction to the core."""


def decimal(value: float, digits: int = 10) -> Expr:
    """Return a double as a decimal of so many digits; it has no more than 16."""
    digits = min(digits, 16)
    if not math.isfinite(value):
        raise WorksheetError("the value is not a finite number")
    text = f"{value:.{digits}g}"
    return number(text if "." in text else text.replace("e", ".0e") if "e" in text else f"{text}.0")


def as_float(value: Expr) -> float | None:
    """Return the number that a constant stands for; None for what isn't one, or is beyond the doubles."""
    if value.is_number:
        numerator, denominator = value.ratio
        try:
            return numerator / denominator
        except OverflowError:
            return None
    if not value.is_constant:
        return None
    try:
        result = value.evaluate({})
    except (ArithmeticError, ValueError):
        return None
    return result if math.isfinite(result) else None


def of_bounded_length(value: Expr) -> Expr:
    """Return a decimal of very many digits rounded to 40; anything else as it is.

    Exact products of decimals have the digits of both factors, so that each step of a loop would take
    longer than the one before. Maple rounds each of them to ``Digits``.

    >>> of_bounded_length(number("0.125"))
    0.125
    >>> exact = number("1.1") ** 400
    >>> len(str(exact.ratio[0])), len(str(of_bounded_length(exact).ratio[0]))
    (417, 39)
    """
    if not (value.is_number and value.is_decimal):
        return value
    if max(part.bit_length() for part in value.ratio) <= _LONG:
        return value
    return number(rounded(value.ratio, _KEPT)) * _ONE


def as_integer(value: object) -> int | None:
    """Return the integer that a value is, or None for another one."""
    if isinstance(value, Expr) and value.is_number and value.ratio[1] == 1:
        return value.ratio[0]
    return None


def with_decimals(value: Expr, *arguments: Expr, digits: int = 10) -> Expr:
    """Return the value of a function as a decimal if all its arguments are numbers and one is a decimal.

    Args:
        value: the value of the function.
        arguments: its arguments.
        digits: how many digits the decimal has.
    """
    if (
        all(each.is_number for each in arguments)
        and any(each.is_decimal for each in arguments)
        and not value.is_number
    ):
        result = as_float(value)
        if result is not None:
            return decimal(result, digits)
    return value


def quotient(a: Expr, b: Expr) -> Expr:
    """Return a / b."""
    if b.is_zero:
        raise WorksheetError("numeric exception: division by zero")
    return a / b


def power(base: Expr, exponent: Expr, digits: int = 10) -> Expr:
    """Return a power, a root of a decimal with so many digits; numbers beyond a million digits are refused."""
    if exponent.is_number and base.is_number:
        if base.is_zero and exponent.ratio[0] < 0:
            raise WorksheetError("numeric exception: division by zero")
        size = abs(exponent.ratio[0]) * max(abs(part).bit_length() for part in base.ratio)
        if size > 3_000_000:
            raise WorksheetError("a power of more than a million digits; it is not computed")
        if base.is_decimal and exponent.ratio[1] == 1 and size > 200:
            value = rounded(base.ratio, 30) ** exponent.ratio[0]
            return number(f"{value:.10g}")
    return with_decimals(base**exponent, base, exponent, digits=digits)
