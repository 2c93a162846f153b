"""Holonomic constraints: their Jacobian, and the forces of their multipliers."""

from __future__ import annotations

from collections.abc import Sequence

from symbody.multibody import System
from symbody.symbolic import Expr, Matrix, derivation, gradient, jacobian, number, time_derivative, zeros


def constraint_jacobian(system: System) -> Matrix:
    """Return ``phi_q = dphi'/du``, m x n: one row per constraint, one column per speed."""
    if not system.constraints:
        return zeros(0, len(system.speeds))
    with derivation():
        if system.has_quasi_velocities:
            return jacobian(system.rate(system.constraints), system.speeds)
        return jacobian(system.constraints, system.coordinates)


def with_multipliers(residuals: Sequence[Expr], system: System) -> tuple[Expr, ...]:
    """Return ``residual - phi_q^T lambda``, one per speed: the forces of the multipliers are on the side of the loads.

    The products are the gradient of ``sum(lambda phi)``. Accumulated backwards through the subexpressions that the
    constraints share, it is shorter than the rows of the Jacobian.
    """
    if not system.constraints:
        return tuple(residuals)
    augmented = number(0)
    for multiplier, constraint in zip(system.multipliers, system.constraints, strict=True):
        augmented += multiplier * constraint
    forces = gradient(augmented, system.coordinates)
    if system.has_quasi_velocities:
        forces = _along_speeds(forces, system)
    return tuple(residual - force for residual, force in zip(residuals, forces, strict=True))


def _along_speeds(forces: Sequence[Expr], system: System) -> tuple[Expr, ...]:
    """Return the power of forces along the coordinates, per unit of each speed."""
    power, kinematics = number(0), system.kinematics
    for coordinate, force in zip(system.coordinates, forces, strict=True):
        power += force * kinematics[time_derivative(coordinate)]
    return gradient(power, system.speeds)
