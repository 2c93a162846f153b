"""Constraints that depend on each other, or leave no motion: notices and errors before anything is derived.

Gaussian elimination in the rows of the Jacobian, ``phi_q = L U``, combines the constraints in the same way: a row that
vanishes belongs to a combination of constraints that is constant, or holds no coordinate.
"""

from __future__ import annotations

import warnings
from collections.abc import Callable, Sequence
from typing import NamedTuple

from symbody.errors import ConstraintError, ModelNotice
from symbody.multibody import System
from symbody.symbolic import Expr, number, t
from symbody.symbolic.given.arguments import brief

from .constraint_force import constraint_jacobian


def check_independent(system: System) -> None:
    """Give a notice of constraints that follow from those before them, at almost every position.

    Raises:
        ConstraintError: a constraint contradicts those before it: a combination of them is a number other than zero.
            Or the independent ones leave no motion, and none of them drives the system.
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
        _report(system, place, combined, combination.value)
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
    """Return what is redundant in a mechanism that moves by its special dimensions alone, if this is one."""
    found = "".join(adviser(system) for adviser in _advisers)
    return found and f". With parameters that are all 1, {found}"


_advisers: list[Callable[[System], str]] = []


def register_adviser(adviser: Callable[[System], str]) -> None:
    """Let a layer above describe redundant constraints that leave no motion, for the error's message.

    That takes numbers, which only layers above know how to find. The adviser returns an empty text if nothing is
    redundant.
    """
    _advisers.append(adviser)


class _Combination(NamedTuple):
    """A combination of constraints.

    Attributes:
        slopes: its derivatives by the speeds that aren't zero, by the places of the speeds.
        value: the combination itself.
    """

    slopes: dict[int, Expr]
    value: Expr

    def without(self, pivot: int, other: _Combination) -> _Combination:
        """Return the combination less a multiple of another one, so that the derivative by one speed vanishes."""
        factor = self.slopes[pivot] / other.slopes[pivot]
        slopes = dict(self.slopes)
        for column, entry in other.slopes.items():
            slopes[column] = slopes.get(column, number(0)) - factor * entry
        left = {column: entry for column, entry in slopes.items() if not entry.is_zero}
        return _Combination(left, self.value - factor * other.value)


def _report(system: System, place: int, combined: Sequence[int], rest: Expr) -> None:
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
        "determined; forward dynamics takes those of minimum norm; leave it out if it is redundant",
        ModelNotice,
        stacklevel=5,
    )


def _named(numbers: Sequence[int]) -> str:
    listed = ", ".join(map(str, numbers))
    return f"constraint {listed}" if len(numbers) == 1 else f"constraints {listed}"
