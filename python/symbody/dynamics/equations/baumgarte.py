"""Baumgarte's stabilisation of constraints [Baumgarte 1972]."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Annotated, TypeAlias

from symbody.geometry import Scalar
from symbody.geometry.component.triple import expression
from symbody.multibody import Variables
from symbody.symbolic import MOTION, Expr, derivation

Damping: TypeAlias = Annotated[
    tuple[Scalar, Scalar] | None,
    "the frequency and the damping ratio of Baumgarte's stabilisation, (omega, zeta)",
]


def stabilized(
    system: Variables, constraints: Sequence[Expr], omega: Scalar, zeta: Scalar
) -> tuple[Expr, ...]:
    """Return ``phi'' + 2 zeta omega phi' + omega^2 phi`` for every constraint phi on positions.

    Where this is kept at zero, a violation of the constraint dies out with the frequency omega and the damping ratio
    zeta, instead of growing. A constraint on velocities ``psi = 0`` has no position that could be off: its row is
    ``psi' + 2 zeta omega psi``.

    Args:
        system: the system to which they belong.
        constraints: its m constraints, in these or other forms.
        omega: the frequency, in rad/s.
        zeta: the damping ratio.

    >>> from symbody import Body, System, functions_of_time, time_derivative, translate
    >>> x, y = functions_of_time("x y")
    >>> guided = System([Body(translate(x, y, 0), 1)], coordinates=[x, y], constraints=[y, time_derivative(x) - 1])
    >>> stabilized(guided, guided.constraints, 1, 0)
    (y'' + y, x'')
    """
    with derivation(order=MOTION):
        accelerations = system.rate(system.velocity_level(constraints))
        return damped(system, constraints, accelerations, omega, zeta)


def damped(
    system: Variables, constraints: Sequence[Expr], accelerations: Sequence[Expr], omega: Scalar, zeta: Scalar
) -> tuple[Expr, ...]:
    """Return accelerations of constraints with the terms of the stabilisation.

    Args:
        system: the system.
        constraints: its m constraints.
        accelerations: the rates of their level of velocities.
        omega: the frequency, in rad/s.
        zeta: the damping ratio.
    """
    frequency, damping = expression(omega), expression(zeta)
    stiffness, viscosity = frequency**2, 2 * damping * frequency
    rates = system.velocity_level(constraints)
    rows = [one + viscosity * rate for one, rate in zip(accelerations, rates, strict=True)]
    for k in system.holonomic:
        rows[k] += stiffness * constraints[k]
    return tuple(rows)
