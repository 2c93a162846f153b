"""Conditions on the forces and speeds of Stribeck's friction, so that the given static friction is reached."""

from __future__ import annotations

from math import exp, sinh, tanh
from typing import Any

from symbody.symbolic import Expr

from .expectation import Expectation

__all__ = ["expected_of_dry_friction", "expected_of_speeds"]

_LEAST_RATIO = 10
"""Of the speeds vs/v0: the steep slope then reaches 0.93 of Fs - Fc before the fall."""
_ROUNDING = 1e-12


def expected_of_dry_friction(static: Expr, coulomb: Expr) -> Expectation:
    """Return the condition ``Fs >= Fc``."""
    return Expectation((static, coulomb), _is_less, _static_fault)


def expected_of_speeds(stribeck: Expr, creep: Expr, excess: Expr) -> Expectation:
    """Return the condition that vs is well above v0, which doesn't matter where ``Fs - Fc`` is zero."""
    known = () if excess.depends_on_time else (excess,)
    return Expectation((stribeck, creep, *known), _is_too_near, _speed_fault)


def reached(ratio: float) -> float:
    """Return the part of Fs - Fc that is reached: the largest ``exp(-(x/r)^2) tanh(x)`` for r = vs/v0.

    There the derivative is zero: ``x sinh(2x) = r^2``.
    """
    low, high = 0.0, ratio
    for _ in range(60):
        x = (low + high) / 2
        low, high = (x, high) if x * sinh(2 * x) < ratio**2 else (low, x)
    return exp(-((low / ratio) ** 2)) * tanh(low)


def _is_less(static: Any, coulomb: Any) -> Any:
    return static < coulomb


def _static_fault(static: float, coulomb: float) -> str:
    return (
        f"static = {static:.6g} is less than coulomb = {coulomb:.6g}; expected at least as much: a joint at rest "
        "resists more than one that slides"
    )


def _is_too_near(stribeck: Any, creep: Any, excess: Any = 1.0) -> Any:
    least = _LEAST_RATIO * (1 - _ROUNDING) * creep
    return (stribeck > 0) & (stribeck < least) & (excess > 0)


def _speed_fault(stribeck: float, creep: float, excess: float = 1.0) -> str:
    del excess
    return (
        f"stribeck_speed = {stribeck:.6g} is near creep_speed = {creep:.6g}, so that the friction falls before it has "
        f"risen: it reaches coulomb + {reached(stribeck / creep):.2f} (static - coulomb) at most; expected a "
        f"stribeck_speed of {_LEAST_RATIO} times creep_speed or more"
    )
