"""Baumgarte's stabilisation of constraints [Baumgarte 1972]."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Annotated, TypeAlias

from symbody.geometry import Scalar
from symbody.geometry.component.triple import Rate, expression
from symbody.symbolic import Expr, derivation, time_derivatives

Damping: TypeAlias = Annotated[
    tuple[Scalar, Scalar] | None,
    "the frequency and the damping ratio of Baumgarte's stabilisation, (omega, zeta)",
]


def stabilized(
    constraints: Sequence[Expr], omega: Scalar, zeta: Scalar, rate: Rate = time_derivatives
) -> tuple[Expr, ...]:
    """Return ``phi'' + 2 zeta omega phi' + omega^2 phi`` for every constraint phi.

    Where this is kept at zero, a violation of the constraint dies out with the frequency omega and the damping ratio
    zeta, instead of growing.

    Args:
        constraints: m expressions phi.
        omega: the frequency, in rad/s.
        zeta: the damping ratio.
        rate: the time derivative; one that writes rates of coordinates by speeds is possible.

    >>> from symbody import functions_of_time
    >>> x = functions_of_time("x")
    >>> stabilized([x], 1, 0)
    (x'' + x,)
    """
    frequency, damping = expression(omega), expression(zeta)
    with derivation():
        first = rate(constraints)
        second = rate(first)
        stiffness, viscosity = frequency**2, 2 * damping * frequency
        return tuple(
            acceleration + viscosity * rate + stiffness * violation
            for violation, rate, acceleration in zip(constraints, first, second, strict=True)
        )
