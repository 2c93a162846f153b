"""Holonomic constraints: their Jacobian, and the forces of their multipliers."""

from __future__ import annotations

import warnings
from collections.abc import Sequence
from importlib import import_module
from typing import NamedTuple

from symbody.errors import ConstraintError, ModelNotice
from symbody.multibody import System
from symbody.symbolic import Expr, Matrix, derivation, gradient, jacobian, number, t, time_derivative, zeros
from symbody.symbolic.given.arguments import brief


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
    """Warn of constraints which, at almost every position, follow from those before them.

    Raises:
        ConstraintError: a constraint contradicts those before it, a combination of them being a number and not zero;
            or those that are independent leave no motion, and none of them drives it.
    """
    pivots: list[tuple[int, _Combination]] = []
    phi_q = constraint_jacobian(system)
    for place, constraint in enumerate(system.constraints):
        slopes = {column: entry for column, entry in enumerate(phi_q.row(place)) if not entry.is_zero}
        combination, combined = _Combination(slopes, constraint), []
        for other, (pivot, reduced) in enumerate(pivots, start=1):
            if pivot in combination.slopes:
                combined.append(other)
                combination = combination.without(pivot, reduced)
        if combination.slopes:
            pivots.append((min(combination.slopes), combination))
            continue
        pivots.append((_NOWHERE, combination))
        _tell(system, place, combined, combination.value)
    _check_motion_is_left(system, sum(pivot != _NOWHERE for pivot, _ in pivots))


_NOWHERE = -1


def _check_motion_is_left(system: System, independent: int) -> None:
    n, what = len(system.speeds), "speeds" if system.quasi_velocities else "coordinates"
    is_driven = any(t in constraint.free_symbols for constraint in system.constraints)
    if independent == n and not is_driven:
        raise ConstraintError(
            f"System: {n} independent constraints on {n} {what} leave no motion; expected fewer constraints than "
            f"{what}, or one that drives the system and holds the time t{_overconstrained(system)}"
        )


def _overconstrained(system: System) -> str:
    """Return what is redundant in a mechanism that moves by its special dimensions alone, if this is one.

    That takes numbers, and so a higher layer, which is looked up for this message only.
    """
    found: str = import_module("symbody.simulation.constraint.redundant_constraints").advice(system)
    return found and f". With parameters that are all 1, {found}"


class _Combination(NamedTuple):
    """A combination of constraints: its derivatives by the speeds, by their places, and its value."""

    slopes: dict[int, Expr]
    value: Expr

    def without(self, pivot: int, other: _Combination) -> _Combination:
        """Return the combination with another one, such that the derivative by one speed vanishes."""
        factor = self.slopes[pivot] / other.slopes[pivot]
        slopes = dict(self.slopes)
        for column, entry in other.slopes.items():
            slopes[column] = slopes.get(column, number(0)) - factor * entry
        left = {column: entry for column, entry in slopes.items() if not entry.is_zero}
        return _Combination(left, self.value - factor * other.value)


def _tell(system: System, place: int, combined: Sequence[int], rest: Expr) -> None:
    constraint, others = (
        f"System: constraint {place + 1}, {brief(system.constraints[place])} = 0,",
        _named(combined),
    )
    if rest.is_constant and not rest.is_zero:
        raise ConstraintError(
            f"{constraint} contradicts {others}: together they say that {brief(rest)} = 0; correct one of them"
        )
    if not rest.is_zero and rest.free_symbols.isdisjoint({*system.coordinates, *system.speeds}):
        warnings.warn(
            f"{constraint} contradicts {others} wherever {rest} isn't zero: their gradients are combinations of each "
            "other; correct one of them, or leave it out",
            ModelNotice,
            stacklevel=5,
        )
        return
    warnings.warn(
        f"{constraint} depends on {others}: its gradient is a combination of theirs, so that their multipliers aren't "
        "determined; forward dynamics takes the least ones; leave it out if it's one too many",
        ModelNotice,
        stacklevel=5,
    )


def _named(numbers: Sequence[int]) -> str:
    listed = ", ".join(map(str, numbers))
    return f"constraint {listed}" if len(numbers) == 1 else f"constraints {listed}"
