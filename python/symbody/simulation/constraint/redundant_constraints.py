"""Redundant constraints of overconstrained mechanisms: which ones, how many, and which to leave out.

A mechanism such as Bricard's moves because of its special dimensions, although it has as many constraints as
coordinates. Where it moves, a combination of their gradients vanishes, and each constraint in it follows from the
others. The choice of the one to leave out matters: the remaining constraints may be nearly dependent at some
positions.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from symbody.errors import SymbodyError
from symbody.multibody import Constraint, Variables
from symbody.multibody.named_constraint import briefly_named
from symbody.simulation.given.values import parameter_values, state_values
from symbody.symbolic import Expr, ExprLike, number
from symbody.symbolic.given.arguments import with_known_names
from symbody.symbolic.given.wording import joined_by_and
from symbody.symbolic.numeric.deficiency import noting, reporting

from .consistent_position import positions
from .kinematics import Kinematics
from .vanishing_combinations import vanishing_combinations
from .walk import CANCELLED, scaled, walk_configurations

__all__ = ["Redundancy", "advice", "redundancy", "redundant_constraints"]

Array = NDArray[np.float64]

NEAR = 5e-2
"""The ratio of singular values below which the remaining constraints are nearly dependent."""
SINGULAR = 5e-2
"""The ratio to its largest value along the walk below which a position is next to a singular one."""
STEPS = 80
"""The number of positions in either direction."""
MOST = 12
"""The largest number of redundant constraints for which each choice is tried."""
_SHOWN = 40
_MUCH = 0.1
"""The ratio of ratios below which one is much smaller."""
_ROUNDED = 1e-3
"""The relative difference of ratios that counts as rounding: machines must not differ in their choice."""


@dataclass(frozen=True, eq=False)
class Redundancy:
    """The redundant constraints of a mechanism.

    Attributes:
        conditions: all constraints, with their names.
        count: how many of them are redundant.
        rows: the indices of those that are dependent.
        ratios: for each of these, the smallest ratio of singular values without it, over all positions of the walk; if
            several are redundant, the best others are left out as well. Empty if there are many.
        choice: the rows to leave out, so that the others are far from dependent.

    >>> from symbody import Body, System, functions_of_time, symbols, translate
    >>> (x, y), m = functions_of_time("x y"), symbols("m")
    >>> twice = System([Body(translate(x, y, 0), m)], coordinates=[x, y], constraints=[x - y, 2 * x - 2 * y])
    >>> found = redundant_constraints(twice)
    >>> found.count, [found.constraints[row] for row in found.rows]
    (1, [x - y, 2*x - 2*y])
    """

    conditions: tuple[Constraint, ...]
    count: int
    rows: tuple[int, ...]
    ratios: Mapping[int, float]
    choice: tuple[int, ...]

    @with_known_names
    def among(self, conditions: tuple[Constraint, ...], places: Sequence[int]) -> Redundancy:
        """Return the same in a longer list of constraints.

        Args:
            conditions: all constraints.
            places: the place among them of each of these.
        """
        return Redundancy(
            conditions,
            self.count,
            tuple(places[row] for row in self.rows),
            {places[row]: ratio for row, ratio in self.ratios.items()},
            tuple(sorted(places[row] for row in self.choice)),
        )

    @with_known_names
    def suits(self, system: Variables, J: Array) -> bool:
        """Return whether the same choice leaves all independent constraints of another position, far from dependent.

        Args:
            system: the mechanism.
            J: the Jacobian of its constraints there, with the column of the time if that leads them.
        """
        rank = int(np.linalg.matrix_rank(scaled(J), CANCELLED))
        here = _for_speeds(system, scaled(J), self.count)
        return rank == len(J) - self.count and _least([here], self.choice, self.count) >= NEAR

    @property
    def constraints(self) -> tuple[Expr, ...]:
        """All constraints as expressions that are zero."""
        return tuple(each.condition for each in self.conditions)

    def __str__(self) -> str:
        """Return what is redundant, and what to leave out."""
        if not self.count:
            return "the constraints are independent where the mechanism moves"
        names = joined_by_and(briefly_named(self.conditions, self.rows, most=_SHOWN), most=8)
        amount = "one" if self.count == 1 else str(self.count)
        return (
            f"the mechanism is overconstrained: constraints {names} depend on each other wherever it moves, {amount} "
            f"of them redundant; leave out {amount}{self.choices}"
        )

    @property
    def choices(self) -> str:
        """The constraints to leave out and those to keep, with the ratios if each choice was tried."""
        if not self.ratios:
            return f", such as {joined_by_and([str(row + 1) for row in self.choice], most=MOST)}"
        best = max(self.ratios.values())
        good = [row for row, ratio in self.ratios.items() if ratio > best / 2]
        bad = [row for row, ratio in self.ratios.items() if ratio < min(NEAR, best / 4)]
        numbers = ", ".join(f"{row + 1}: {ratio:.2g}" for row, ratio in self.ratios.items())
        warning = (
            f"; not {_either(bad)}, without which the others are nearly dependent at some positions"
            if bad
            else ""
        )
        ratios = f"smallest ratio of singular values of the remaining constraints, without {numbers}"
        return f", best {_either(good)}{warning} ({ratios})"


def _either(rows: Sequence[int]) -> str:
    names = [str(row + 1) for row in rows]
    return " or ".join(filter(None, [", ".join(names[:-1]), names[-1]]))


@with_known_names
def redundant_constraints(
    system: Variables,
    parameters: Mapping[Expr, ArrayLike] | None = None,
    initial: Mapping[Expr, ArrayLike] | None = None,
    *,
    guess: Mapping[Expr, ArrayLike] | None = None,
    t: float = 0.0,
    inputs: Mapping[Expr, ExprLike] | None = None,
) -> Redundancy:
    """Return which constraints of an overconstrained mechanism are redundant, and what to leave out.

    ``y^T phi_q = 0`` at all positions that the mechanism reaches from the first one. The rows of ``phi_q`` are scaled
    to the length 1 before the singular values are computed.

    Args:
        system: the mechanism.
        parameters: the values of the symbols in the constraints; others are allowed.
        initial: the given values of coordinates.
        guess: the values near which the others should be.
        t: the time, in s.
        inputs: expressions of time for the input functions of time.

    Raises:
        ConstraintError: no position satisfies the constraints.
        ParameterError: a value is missing, has an unknown key, or is not finite.

    >>> from symbody import Body, System, functions_of_time, symbols, translate
    >>> (x, y), m = functions_of_time("x y"), symbols("m")
    >>> twice = System([Body(translate(x, y, 0), m)], coordinates=[x, y], constraints=[x - y, 2 * x - 2 * y])
    >>> redundant_constraints(twice).rows
    (0, 1)
    """
    where = "redundant_constraints"
    kinematics = Kinematics(system, tuple((name, number(value)) for name, value in (inputs or {}).items()))
    kinematics.check_inputs(where)
    p = parameter_values(kinematics.parameters, parameters, where=where)
    fixed, near = (
        state_values(system, given, where=where, argument=name, has_speeds=False)
        for given, name in ((initial, "initial"), (guess, "guess"))
    )
    with reporting(where):
        begin = positions(kinematics, p, t, fixed, near, where)
        return redundancy(system, [scaled(J) for J in walk_configurations(kinematics, p, t, begin, STEPS)])


def advice(system: Variables) -> str:
    """Return what is redundant if all parameters are 1; the empty text if nothing is, or if no position is found."""
    kinematics = Kinematics(system)
    try:
        with noting():  # the user did not ask for this evaluation
            found = redundant_constraints(system, dict.fromkeys(kinematics.parameters, 1.0))
    except (SymbodyError, np.linalg.LinAlgError):
        return ""
    return str(found) if found.count else ""


def redundancy(system: Variables, gradients: Sequence[Array]) -> Redundancy:
    """Return what is redundant, from Jacobians at some positions, with rows scaled to the length 1.

    These may have one column more than there are speeds, that of the time. It counts for what is redundant, but not for
    the choice: at each instant, the speeds follow from the constraints that are left, without it. Constraints on
    velocities are rather left out than those on positions, which they cannot keep from drifting.
    """
    conditions = system.conditions
    on_velocity = {*range(len(conditions))} - {*system.holonomic}
    combinations = [vanishing_combinations(J, CANCELLED) for J in gradients]
    count = min((len(found) for found in combinations), default=0)
    regular = [(J, found) for J, found in zip(gradients, combinations, strict=True) if len(found) == count]
    rows = sorted({int(row) for _, found in regular for y in found for row in np.flatnonzero(y)})
    places = _apart_from_singular([_for_speeds(system, J, count) for J, _ in regular], count)
    if len(rows) > MOST:
        return Redundancy(conditions, count, tuple(rows), {}, _pivots(places, count))
    removals = {row: _removal(places, row, rows, count, on_velocity) for row in rows}
    ratios = {row: _least(places, removed, count) for row, removed in removals.items()}
    choice = tuple(sorted(removals[_best(ratios, on_velocity)])) if rows else ()
    return Redundancy(conditions, count, tuple(rows), ratios, choice)


def _best(ratios: Mapping[int, float], preferred: Collection[int]) -> int:
    """Return the row with the largest ratio; of rows with the same ratio up to rounding, the last.

    Args:
        ratios: the smallest ratio of singular values without each row.
        preferred: rows that are chosen unless their ratios are much smaller.
    """
    largest = max(ratios.values())
    fit = {row: ratio for row, ratio in ratios.items() if row in preferred and ratio >= largest * _MUCH}
    if fit and len(fit) < len(ratios):
        return _best(fit, ())
    return max(row for row, ratio in ratios.items() if ratio >= largest * (1 - _ROUNDED))


def _removal(
    places: Sequence[Array], row: int, rows: Sequence[int], count: int, preferred: Collection[int]
) -> list[int]:
    """Return a row and the best choice of the others to leave out.

    Args:
        places: Jacobians of the constraints at some positions.
        row: the row that is left out first.
        rows: the rows that are dependent.
        count: how many are left out.
        preferred: rows that are rather left out.
    """
    removed = [row]
    while len(removed) < count:
        others = {r: _least(places, [*removed, r], count) for r in rows if r not in removed}
        removed.append(_best(others, preferred))
    return removed


def _pivots(places: Sequence[Array], count: int) -> tuple[int, ...]:
    """Return rows to leave out by QR decomposition of the combinations that vanish at the most regular position.

    The rows with pivots are those that the others determine best; trying each choice would take too long. Of pivots of
    the same size up to rounding, as a symmetric mechanism has, the last is taken, so that all machines choose the same.
    """
    regularity = np.array([_ratio(J, count) for J in places])
    regular = places[int(np.argmax(_nearly_largest(regularity)))]
    combinations = np.linalg.svd(regular)[0][:, len(regular) - count :]
    pivots = []
    for _ in range(count):
        squares = (combinations**2).sum(axis=1)
        pivots.append(int(np.flatnonzero(_nearly_largest(squares))[-1]))
        taken = combinations[pivots[-1]] / np.sqrt(squares[pivots[-1]])
        combinations = combinations - np.outer(combinations @ taken, taken)
    return tuple(sorted(pivots))


def _nearly_largest(values: Array) -> NDArray[np.bool_]:
    found: NDArray[np.bool_] = values >= values.max() * (1 - _ROUNDED)
    return found


def _for_speeds(system: Variables, J: Array, count: int) -> Array:
    """Return the columns of the speeds, unless more constraints are independent than there are speeds."""
    n = len(system.speeds)
    return scaled(J[:, :n]) if n < J.shape[1] and len(J) - count <= n else J


def _apart_from_singular(places: Sequence[Array], count: int) -> list[Array]:
    """Return the positions that are not next to singular ones, where every choice leaves dependent constraints."""
    own = np.array([_ratio(J, count) for J in places])
    return [J for J, ratio in zip(places, own, strict=True) if ratio >= SINGULAR * own.max(initial=0.0)]


def _least(places: Sequence[Array], removed: Sequence[int], count: int) -> float:
    """Return the smallest ratio of singular values over all positions, without the removed rows."""
    left = count - len(removed)
    return min(_ratio(np.delete(J, list(removed), axis=0), left) for J in places)


def _ratio(J: Array, count: int) -> float:
    """Return the ratio of the least to the largest singular value, without the smallest `count` of them.

    It is zero if all rows vanish, such as those of constraints that are stationary wherever they hold.
    """
    rank = len(J) - count
    if not rank:
        return 1.0
    s = np.linalg.svd(J, compute_uv=False)
    return float(s[rank - 1] / s[0]) if s[0] > 0 else 0.0
