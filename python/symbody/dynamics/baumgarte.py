"""Baumgarte's stabilisation of constraints [Baumgarte 1972]."""

from __future__ import annotations

from collections.abc import Sequence

from symbody.geometry import Scalar
from symbody.geometry.triple import expression
from symbody.symbolic import Expr, derivation, time_derivatives


def stabilized(constraints: Sequence[Expr], omega: Scalar, zeta: Scalar) -> tuple[Expr, ...]:
    """Return ``phi'' + 2 zeta omega phi' + omega^2 phi`` for every constraint phi.

    A violation of the constraint then dies out with frequency omega and damping ratio zeta, instead of growing.

    >>> from symbody import functions_of_time
    >>> x = functions_of_time("x")
    >>> stabilized([x], 1, 0)
    (x'' + x,)
    """
    frequency, damping = expression(omega), expression(zeta)
    with derivation():
        first = time_derivatives(constraints)
        second = time_derivatives(first)
        stiffness, viscosity = frequency**2, 2 * damping * frequency
        return tuple(
            acceleration + viscosity * rate + stiffness * violation
            for violation, rate, acceleration in zip(constraints, first, second, strict=True)
        )
