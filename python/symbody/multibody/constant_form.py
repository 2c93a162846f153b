"""Expressions that hold functions of time without depending on them: ``cos(q + a)*cos(q) + sin(q + a)*sin(q)``."""

from __future__ import annotations

from symbody.errors import DivisionByZeroError
from symbody.symbolic import Expr, number


def constant_form(value: Expr) -> Expr | None:
    """Return a constant without functions of time; None if the value changes with time.

    If a value is the same at one position as at all others, then it is what it is there.
    """
    if not value.depends_on_time:
        return value
    leaves = [leaf for leaf in value.free_symbols if leaf.depends_on_time]
    for place in (0, 1):  # at zero, the quaternion of a floating frame has no norm by which it can be divided
        try:
            here = value.subs(dict.fromkeys(leaves, number(place)))
        except DivisionByZeroError:
            continue
        return here if here == value else None
    return None


_ROUNDED = 1e-12
"""The relative difference of numbers that rounding explains."""


def agree(one: Expr, other: Expr) -> bool:
    """Return whether two entries of a symmetric matrix are equal; numbers up to rounding.

    >>> from symbody import number
    >>> agree(number(0.1 + 0.2), number(0.3)), agree(number(1), number(2))
    (True, False)
    """
    if one == other or not (one.is_constant and other.is_constant):
        return one == other
    return abs(float(one) - float(other)) <= _ROUNDED * max(abs(float(one)), abs(float(other)))
