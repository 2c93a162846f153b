"""Constraints that depend on each other, or leave no motion: notices and errors before anything is derived.

Gaussian elimination in the rows of the Jacobian, ``phi_q = L U``, combines the constraints in the same way: a row that
vanishes belongs to a combination of constraints that is constant, or holds no coordinate.
"""

from __future__ import annotations

import warnings
from collections.abc import Sequence
from importlib import import_module
from typing import NamedTuple

from symbody.errors import ConstraintError, ModelError, ModelNotice
from symbody.multibody import Variables
from symbody.multibody.named_constraint import redundant
from symbody.symbolic import Expr, free_symbols, number, substitute, t
from symbody.symbolic.given.arguments import brief, counted

from .constraint_force import constraint_jacobian

ADVISED_BY = "symbody.simulation.constraint.redundant_constraints"
"""A module name, not an import: it is loaded when the message of an error needs it."""


def check_independent(system: Variables) -> None:
    """Give a notice of constraints that follow from those before them, and of those that leave no motion.

    Both hold at almost every position, for almost all parameters: special dimensions may let a mechanism move.

    Raises:
        ModelError: there is no motion without constraints either.
        ConstraintError: a constraint contradicts those before it: a combination of them is a number other than zero.
            Or the independent ones leave no motion whatever the dimensions are, and none of them drives the system.
    """
    if not system.speeds:
        raise ModelError(
            f"{system.where}: no joint lets anything move, so that there are no coordinates and no equations of "
            "motion; the forces in the joints of a structure are reaction(system, joint)"
        )
    pivots: dict[int, _Combination] = {}
    found: list[str] = []
    phi_q, rates = constraint_jacobian(system), _rates(system)
    for place in (*system.holonomic, *_nonholonomic(system)):
        slopes = {column: entry for column, entry in enumerate(phi_q.row(place)) if not entry.is_zero}
        combination, combined = _Combination(slopes, system.constraints[place], rates[place]), []
        for other, reduced in pivots.items():
            if reduced.slopes and reduced.pivot in combination.slopes:
                combined.append(other + 1)
                combination = combination.without(reduced)
        pivots[place] = combination
        if not combination.slopes:
            rest = combination.value if place in system.holonomic else combination.rate
            found.append(_report(system, place, combined, rest))
    independent = [each for each in pivots.values() if each.slopes]
    if len(independent) == len(system.speeds) and not demands_motion(system):
        found = [
            _without_motion(system, independent)
        ]  # any other constraint depends on as many as there are speeds
    for notice in found:
        warnings.warn(notice, ModelNotice, stacklevel=4)


def _nonholonomic(system: Variables) -> tuple[int, ...]:
    return tuple(k for k in range(len(system.constraints)) if k not in system.holonomic)


def _rates(system: Variables) -> tuple[Expr, ...]:
    """Return the constraints on the level of velocities where some of them have no other; zeros if none has."""
    if system.is_holonomic:
        return (number(0),) * len(system.constraints)
    return system.velocity_level(system.constraints)


def _without_motion(system: Variables, independent: Sequence[_Combination]) -> str:
    """Return a notice of constraints that leave no motion; raise an error if no dimensions can change that."""
    n, what = len(system.speeds), "speeds" if system.has_quasi_velocities else "coordinates"
    on = f"{counted(n, 'independent constraint')} on {counted(n, what[:-1])}"
    found = f"{system.where}: {on} {'leaves' if n == 1 else 'leave'} no motion"
    is_held = all(
        each.slopes[each.pivot].is_constant for each in independent
    )  # so is their product, the determinant
    if is_held and system.joints:
        return f"{found}: nothing moves, and reactions are those of statics, which equilibrium(equations, ...) finds"
    if is_held:
        raise ConstraintError(
            f"{found}; expected fewer constraints than {what}, or one that drives the system and holds the time t"
        )
    redundant = _what_is_redundant(system)
    if all(leaf.depends_on_time for leaf in free_symbols(system.constraints)):
        where_it_moves = f"; where it moves, {redundant}; a simulation does so by itself"
        return f"{found} at almost every position{where_it_moves if redundant else _STRUCTURE}"
    advice = (
        f"With parameters that are all 1, {redundant}; a simulation does so by itself"
        if redundant
        else f"With parameters that are all 1 nothing moves{_SPECIAL}"
    )
    return f"{found} for almost all dimensions. {advice}"


_STRUCTURE = (
    "; leave out a constraint, unless nothing shall move: equilibrium(equations, ...) finds the reactions of a "
    "structure"
)
_SPECIAL = (
    "; leave out a constraint, unless the dimensions that you will give are special ones, or nothing shall move: "
    "equilibrium(equations, ...) finds the reactions of a structure"
)


def demands_motion(system: Variables) -> bool:
    """Return whether constraints demand speeds other than zero."""
    given = {t, *(each for each in system.inputs if each.kind == "time_function")}
    if any(not given.isdisjoint(constraint.free_symbols) for constraint in system.constraints):
        return True
    demanded = substitute(_rates(system), dict.fromkeys(system.speeds, number(0)))
    return not all(each.is_zero for each in demanded)


def _what_is_redundant(system: Variables) -> str:
    """Describe redundant constraints: that takes numbers, which a layer above knows how to find."""
    text: str = import_module(ADVISED_BY).advice(system)
    return text


class _Combination(NamedTuple):
    """A combination of constraints.

    Attributes:
        slopes: its derivatives by the speeds that aren't zero, by the places of the speeds.
        value: the combination itself, of constraints on positions.
        rate: the combination of what the constraints are on the level of velocities.
    """

    slopes: dict[int, Expr]
    value: Expr
    rate: Expr

    @property
    def pivot(self) -> int:
        """The first speed that it holds."""
        return min(self.slopes)

    def without(self, other: _Combination) -> _Combination:
        """Return the combination less a multiple of another one, so that the derivative by its pivot vanishes."""
        factor = self.slopes[other.pivot] / other.slopes[other.pivot]
        slopes = dict(self.slopes)
        for column, entry in other.slopes.items():
            slopes[column] = slopes.get(column, number(0)) - factor * entry
        left = {column: entry for column, entry in slopes.items() if not entry.is_zero}
        return _Combination(left, self.value - factor * other.value, self.rate - factor * other.rate)


def _report(system: Variables, place: int, combined: Sequence[int], rest: Expr) -> str:
    """Return a notice of a constraint that depends on others; raise an error if it contradicts them everywhere."""
    constraint, others = (
        f"{system.where}: constraint {place + 1}, {system.conditions[place]},",
        _named(combined),
    )
    if rest.is_constant and not rest.is_zero:
        raise ConstraintError(
            f"{constraint} contradicts {others}: together they say that {brief(rest)} = 0; correct one of them"
        )
    if not rest.is_zero and _contradicts(system, place, rest):
        return (
            f"{constraint} contradicts {others} wherever {rest} isn't zero: their gradients are combinations of each "
            "other; correct one of them, or leave it out"
        )
    if not combined:
        return f"{constraint} always holds, and restrains nothing; leave it out, or correct it"
    rows = sorted(other - 1 for other in combined)
    said = redundant(system.conditions, [place], rows, by_slopes=not rest.is_zero)
    return (
        f"{system.where}: {said}: its gradient is a combination of theirs, so that their multipliers aren't "
        "determined: forward dynamics takes those of minimum norm, and a simulation leaves out what is redundant"
    )


def _contradicts(system: Variables, place: int, rest: Expr) -> bool:
    """Return whether what is left of a combination can't be a matter of the position alone."""
    return place not in system.holonomic or rest.free_symbols.isdisjoint(
        {*system.coordinates, *system.speeds}
    )


def _named(numbers: Sequence[int]) -> str:
    listed = ", ".join(map(str, numbers))
    return f"constraint {listed}" if len(numbers) == 1 else f"constraints {listed}"
