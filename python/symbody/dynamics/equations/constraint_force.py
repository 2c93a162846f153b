"""Constraints on positions and on velocities: their Jacobian, and the forces of their multipliers."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TypeAlias

from symbody.multibody import Variables
from symbody.symbolic import (
    ENERGY,
    MOTION,
    Expr,
    Matrix,
    derivation,
    gradient,
    jacobian,
    number,
    time_derivative,
    truncated,
    with_shared_sums,
    zeros,
)

from .constraint_form import in_shortest_form

_Forces: TypeAlias = tuple[tuple[Expr, ...], tuple[Expr, ...]]
"""Of constraints on positions, and of those on velocities; one per speed."""


def constraint_jacobian(system: Variables) -> Matrix:
    """Return A of ``A u + b``, m x n: ``dphi'/du`` of constraints on positions; one row each, a column per speed."""
    if not system.constraints:
        return zeros(0, len(system.speeds))
    constraints = in_shortest_form(system, system.constraints)
    with derivation(order=ENERGY):
        if system.has_quasi_velocities or not system.is_holonomic:
            A = jacobian(system.velocity_level(constraints), system.speeds)
        else:
            A = jacobian(constraints, system.coordinates)
        return Matrix.from_entries(*A.shape, truncated(A.entries, MOTION))


def in_shared_sums(residuals: Sequence[Expr], system: Variables) -> tuple[Expr, ...]:
    """Return residuals whose sums share common parts if there are constraints, since each force is in many rows.

    Args:
        residuals: the residuals, with the forces of the multipliers.
        system: the system.
    """
    return with_shared_sums(residuals) if system.constraints else tuple(residuals)


def with_multipliers(residuals: Sequence[Expr], system: Variables) -> tuple[Expr, ...]:
    """Return ``residual - A^T lambda``, one per speed: the forces of the multipliers are on the side of the loads.

    The products are the gradient of ``sum(lambda phi)`` by the coordinates, or of ``sum(lambda (A u + b))`` by the
    speeds. Accumulated backwards through the subexpressions that the constraints share, it is shorter than the rows of
    the Jacobian.
    """
    if not system.constraints:
        return tuple(residuals)
    with derivation(order=ENERGY) as current:
        known: dict[Variables, _Forces] = current.cache.setdefault("forces of constraints", {})
        if system not in known:
            known[system] = _forces_on_positions(system), _forces_on_velocities(system)
    return tuple(
        residual - position - velocity
        for residual, position, velocity in zip(residuals, *known[system], strict=True)
    )


def _forces_on_positions(system: Variables) -> tuple[Expr, ...]:
    constraints = in_shortest_form(system, system.constraints)
    forces = gradient(_multiplied(system, constraints, on_position=True), system.coordinates)
    return _along_speeds(forces, system) if system.has_quasi_velocities else forces


def _forces_on_velocities(system: Variables) -> tuple[Expr, ...]:
    if system.is_holonomic:
        return (number(0),) * len(system.speeds)
    constraints = system.by_speeds(in_shortest_form(system, system.constraints))
    return gradient(_multiplied(system, constraints, on_position=False), system.speeds)


def _multiplied(system: Variables, constraints: Sequence[Expr], *, on_position: bool) -> Expr:
    """Return the sum of the constraints of one kind, each times its multiplier."""
    augmented = number(0)
    for k, (multiplier, constraint) in enumerate(zip(system.multipliers, constraints, strict=True)):
        if (k in system.holonomic) == on_position:
            augmented += multiplier * constraint
    return augmented


def _along_speeds(forces: Sequence[Expr], system: Variables) -> tuple[Expr, ...]:
    """Return the power of forces along the coordinates, per unit of each speed."""
    power, kinematics = number(0), system.kinematics
    for coordinate, force in zip(system.coordinates, forces, strict=True):
        power += force * kinematics[time_derivative(coordinate)]
    return gradient(power, system.speeds)
