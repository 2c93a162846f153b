"""Multiples of pi that are given as doubles: ``math.pi/2`` is pi/2, ``math.radians(30)`` is pi/6.

No double is exactly a multiple of pi. In the angle of a rotation, and in a sum in the argument of a sine,
cosine or tangent, a decimal within two rounding errors of ``k*pi/n`` with n up to 360 becomes that multiple; above
1000, n goes up to 12; above 1e6, no decimal is a multiple. The sine of a number alone is evaluated at that
number: it is data, and `sin(3.141592653589793)` is not zero. Decimals with fewer digits, such as 1.5708, remain
decimals; `meant_multiple_of_pi` finds the multiple that they probably mean.
"""

from __future__ import annotations

from math import pi as PI

from symbody.symbolic import _core
from symbody.symbolic._core import Expr
from symbody.symbolic.expression.leaves import ExprLike, pi

__all__ = ["exact_angle", "meant_multiple_of_pi", "multiple_of_pi", "radians"]

#: Denominators of the multiples that people round: those of 15, 18 and 22.5 degrees.
_DENOMINATORS = (1, 2, 3, 4, 5, 6, 8, 10, 12)

#: A decimal means a fraction of pi with denominator n if it is within this part of 1/n^2: 0.785 does, 0.79 does not.
_NARROW = 0.01

#: The relative precision of half of a double's digits, about that of single precision.
_HALF_OF_THE_DIGITS = 1e-6


def exact_angle(angle: ExprLike) -> Expr:
    """Return an angle with its decimals replaced by the multiples of pi that they stand for.

    >>> import math
    >>> from symbody import functions_of_time
    >>> exact_angle(functions_of_time("q") + math.pi / 2)
    q + pi/2
    """
    return _core.angle(angle, "angle")


def radians(angle: Expr) -> Expr:
    """Return the numeric part of an angle, without multiples of pi."""
    return _core.radians(angle)


def multiple_of_pi(angle: float, tolerance: float) -> Expr | None:
    """Return the nonzero ``k*pi/n`` with the least n up to 360 within a tolerance of an angle, or None."""
    found = _core.multiple_of_pi(angle, tolerance)
    return None if found is None else pi * found[0] / found[1]


def meant_multiple_of_pi(angle: Expr) -> Expr | None:
    """Return the multiple of pi that a decimal of few digits, or of single precision, probably means, or None.

    Its digits must be those of the multiple, rounded or truncated: 0.785 is pi/4; 3.57 is near 25*pi/22, but it is
    a measured angle.

    >>> from symbody import number
    >>> [meant_multiple_of_pi(number(angle)) for angle in (1.5708, 3.14, 0.785, 0.79, 3.57)]
    [pi/2, pi, pi/4, None, None]
    """
    value = float(angle)
    if not angle.is_decimal or value == 0:
        return None
    unit = _last_decimal(angle)
    for n in _DENOMINATORS:
        k = round(value * n / PI)
        excess = abs(value) - abs(k) * PI / n
        is_rounded = abs(excess) <= _HALF_OF_THE_DIGITS * abs(value) or -unit < excess <= unit / 2
        if k != 0 and is_rounded and abs(excess) <= _NARROW / n**2:
            return pi * k / n
    return None


def _last_decimal(angle: Expr) -> float:
    """Return the unit of the last decimal place of a number that has at least two, otherwise zero."""
    _, denominator = angle.ratio
    decimals = next((n for n in range(17) if 10**n % denominator == 0), 0)
    return 10.0**-decimals if decimals >= 2 else 0.0
