"""Baumgarte's stabilisation of constraints [Baumgarte 1972]."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Annotated, TypeAlias

from symbody.geometry import Scalar
from symbody.geometry.component.triple import expression
from symbody.multibody import Variables
from symbody.symbolic import MOTION, Expr, common_parameters, derivation, number, with_shared_sums

from .constraint_form import in_shortest_form

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


def stabilized_beside(
    residuals: Sequence[Expr], system: Variables, constraints: Sequence[Expr], omega: Scalar, zeta: Scalar
) -> tuple[Expr, ...]:
    """Return the same in the form that takes the fewest operations beside the residuals.

    Args:
        residuals: the residuals, whose nodes the rows take where values agree.
        system: the system.
        constraints: its m constraints.
        omega: the frequency, in rad/s.
        zeta: the damping ratio.
    """
    short = in_shortest_form(system, constraints)
    with derivation(fresh=True, order=MOTION):
        for residual in residuals:
            residual + 0
        rows = stabilized(system, short, omega, zeta)
    return with_shared_sums(rows, residuals)


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
    positions = [phi if k in system.holonomic else number(0) for k, phi in enumerate(constraints)]
    rows = []
    for levels in zip(accelerations, system.velocity_level(constraints), positions, strict=True):
        factor, (acceleration, rate, position) = common_parameters(levels)
        rows.append(factor * (acceleration + viscosity * rate + stiffness * position))
    return tuple(rows)
