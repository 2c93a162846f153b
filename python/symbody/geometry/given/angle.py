"""Angles in radians, with doubles that are rounded multiples of pi taken as these."""

from __future__ import annotations

from collections.abc import Mapping
from math import pi

from symbody.errors import notify
from symbody.geometry.component.triple import Scalar
from symbody.symbolic import Expr, exact_angle, meant_multiple_of_pi, radians
from symbody.symbolic.given.arguments import brief


def angle(value: Scalar, where: str) -> Expr:
    """Return an angle with rounded multiples of pi replaced by exact ones; report what looks like a mistake.

    There is a notice for a number that is a multiple of pi with digits left out, or more than a full turn.
    """
    exact = exact_angle(value)
    _report(value, exact, where)
    return exact


def substituted(old: Expr, substitution: Mapping[Expr, Scalar]) -> Expr:
    """Return an angle with expressions substituted; report new numbers that look like a mistake."""
    value = old.subs(substitution)
    exact = exact_angle(value)
    if radians(exact) != radians(old):
        _report(value, exact, "subs")
    return exact


def _report(value: Scalar, exact: Expr, where: str) -> None:
    number = radians(exact)
    if number.is_zero:
        return
    shown = f"{where}: angle = {brief(value)}" + ("" if exact.is_number else f" holds {number}, which")
    meant = meant_multiple_of_pi(number)
    gap = 0.0 if meant is None else abs(float(number) - float(meant))
    if gap > 0:
        notify(f"{shown} is within {gap:.2g} of {meant}; write {meant} with symbody.pi if that is meant")
    elif abs(float(number)) > 2 * pi:
        notify(
            f"{shown} is more than a full turn; angles are in radians: write math.radians({number}) if degrees are "
            "meant"
        )
