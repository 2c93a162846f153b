"""Holonomic constraints: their Jacobian, and the forces of their multipliers."""

from __future__ import annotations

from collections.abc import Sequence

from symbody.errors import ConstraintError
from symbody.multibody import System
from symbody.symbolic import Expr, Matrix, derivation, gradient, jacobian, number, time_derivative, zeros


def constraint_jacobian(system: System) -> Matrix:
    """Return ``phi_q = dphi'/du``, a row a constraint and a column a speed."""
    if not system.constraints:
        return zeros(0, len(system.speeds))
    with derivation():
        if system.has_quasi_velocities:
            return jacobian(system.rate(system.constraints), system.speeds)
        return jacobian(system.constraints, system.coordinates)


def with_multipliers(residuals: Sequence[Expr], system: System) -> tuple[Expr, ...]:
    """Return ``residual - phi_q^T lambda``: the multipliers' forces stand on the side of the loads.

    The products are the gradient of ``sum(lambda phi)``: taken backwards through what the constraints share, it is
    shorter than the Jacobian's rows.
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
    power = number(0)
    for coordinate, force in zip(system.coordinates, forces, strict=True):
        power += force * system.kinematics.get(coordinate, time_derivative(coordinate))
    return gradient(power, system.speeds)


def check_independent(system: System) -> None:
    """Raise an error that names the first constraint which, at almost every position, follows from those before it."""
    pivots: list[tuple[int, dict[int, Expr]]] = []
    phi_q = constraint_jacobian(system)
    for place in range(len(system.constraints)):
        row = {column: entry for column, entry in enumerate(phi_q.row(place)) if not entry.is_zero}
        combined = []
        for other, (pivot, reduced) in enumerate(pivots, start=1):
            if pivot in row:
                combined.append(other)
                row = _eliminated(row, pivot, reduced)
        if not row:
            raise ConstraintError(
                f"System: constraint {place + 1}, {system.constraints[place]} = 0, depends on "
                f"{_named(combined)}: its gradient is a combination of theirs; leave it out"
            )
        pivots.append((min(row), row))


def _eliminated(row: dict[int, Expr], pivot: int, reduced: dict[int, Expr]) -> dict[int, Expr]:
    factor = row[pivot] / reduced[pivot]
    result = dict(row)
    for column, entry in reduced.items():
        value = result[column] - factor * entry if column in result else -factor * entry
        if value.is_zero:
            del result[column]
        else:
            result[column] = value
    return result


def _named(numbers: Sequence[int]) -> str:
    listed = ", ".join(map(str, numbers))
    return f"constraint {listed}" if len(numbers) == 1 else f"constraints {listed}"
