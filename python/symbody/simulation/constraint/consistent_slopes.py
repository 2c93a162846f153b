"""The derivatives of a consistent state by parameters and by given values.

A consistent state is the nearest one: ``min |q - q0|^2`` with ``phi(q, p) = 0`` over the values that are not given,
then the same for the speeds (`consistent_position`, `consistent_velocity`). Its derivatives follow from the conditions
of the minimum by the implicit function theorem [Fiacco 1983]:

    q - q0 + phi_q^T mu = 0,   phi = 0        solved for dq and dmu
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from symbody.codegen import lambdify
from symbody.errors import ConstraintError, SimulationError
from symbody.symbolic import Expr, derivation, gradient, jacobian, number, symbol, t, time_derivative
from symbody.symbolic.given.wording import joined_by_and

from .consistent_position import ROUNDED
from .kinematics import Kinematics, neutral_position
from .least_norm import least_norm

__all__ = ["ConsistentStart", "consistent_slopes"]

Array = NDArray[np.float64]
Values = Mapping[Expr, float]

_EXACT = 1e-9
"""The residual of the equations of the derivatives, relative to their terms, up to which they count as solved."""
_WHERE = "simulate, sensitivities"


@dataclass(frozen=True, eq=False)
class ConsistentStart:
    """A consistent state, and what it was found from.

    Attributes:
        kinematics: the constraints and the kinematics.
        parameters: the values of the parameters.
        state: coordinates, speeds and states beside the mechanics, shape (n,).
        fixed: the values that were given.
        guess: the values near which the others are.
        t: the time, in s.
    """

    kinematics: Kinematics
    parameters: Values
    state: Array
    fixed: Values
    guess: Values
    t: float

    @property
    def variables(self) -> tuple[Expr, ...]:
        """The coordinates, the speeds and the states."""
        system = self.kinematics.system
        return (*system.coordinates, *system.speeds, *system.states)

    @property
    def values(self) -> dict[Expr, float]:
        """The values of the variables, the parameters and the time."""
        return {
            **self.parameters,
            **dict(zip(self.variables, map(float, self.state), strict=True)),
            t: self.t,
        }


def consistent_slopes(start: ConsistentStart, by: Sequence[Expr]) -> Array:
    """Return the derivatives of a consistent state by parameters and given initial values, shape (n, k).

    Args:
        start: the consistent state.
        by: parameters, and coordinates, speeds, rates and states whose values were given.

    Raises:
        ConstraintError: the given values satisfy the constraints for these values of the parameters only.
        SimulationError: the state does not follow smoothly from what is given, or an initial value was not given.
    """
    _check_given(start, by)
    system = start.kinematics.system
    nq, nu = len(system.coordinates), len(system.speeds)
    slopes = np.zeros((len(start.variables), len(by)))
    for row, name in enumerate(start.variables):
        slopes[row] = [float(p == name) for p in by]
    slopes[:nq] = _of_positions(start, by, slopes[:nq])
    slopes[nq : nq + nu] = _of_velocities(start, by, slopes)
    return slopes


def _check_given(start: ConsistentStart, by: Sequence[Expr]) -> None:
    system = start.kinematics.system
    for name in by:
        if name in system.state_names and name not in start.fixed and name not in system.states:
            raise SimulationError(
                f"{_WHERE}: the initial value of {name} isn't given, it is what the constraints and the kinematics "
                f"demand; give it in initial={{{name}: ...}}, or leave it out of the sensitivities"
            )
    if system.momenta:
        raise SimulationError(
            f"{_WHERE}: the speeds of the equations are momenta; expected equations in speeds, such as "
            "newton_euler(system)"
        )
    rates = [time_derivative(q) for q in system.coordinates]
    guessed = [str(name) for name in start.guess if name in rates and name not in system.speeds]
    if guessed:
        raise SimulationError(
            f"{_WHERE}: the guess of {joined_by_and(guessed)} is a guess of several speeds at once, whose derivatives "
            "aren't known; give it in initial, or guess speeds"
        )


def _of_positions(start: ConsistentStart, by: Sequence[Expr], given: Array) -> Array:
    """Return the derivatives of the coordinates; those of given ones are known."""
    kinematics, q = start.kinematics, list(start.kinematics.system.coordinates)
    free = [name for name in q if name not in start.fixed]
    if not kinematics.position_constraints:
        return given
    neutral = dict(zip(q, neutral_position(kinematics.system), strict=True))
    near = {name: start.guess.get(name, neutral[name]) for name in free}
    distances = [name - number(near[name]) for name in free]
    problem = _Nearest(start, by, free, distances, list(kinematics.position_constraints))
    others = [name for name in q if name not in free]
    found = given.copy()
    rows = [q.index(name) for name in free]
    found[rows] = problem.slopes(others, given[[q.index(name) for name in others]])
    return found


def _of_velocities(start: ConsistentStart, by: Sequence[Expr], given: Array) -> Array:
    """Return the derivatives of the speeds, given those of the coordinates, the given speeds and the states."""
    kinematics, system = start.kinematics, start.kinematics.system
    speeds, rates = list(system.speeds), [time_derivative(q) for q in system.coordinates]
    nq = len(system.coordinates)
    free = [name for name in speeds if name not in start.fixed]
    if not free:
        problem = _Nearest(start, by, free, [], list(kinematics.velocity_constraints))
        problem.slopes(list(start.variables), given)
        return given[nq : nq + len(speeds)]
    written = dict(zip(rates, kinematics.coordinate_rates, strict=True)) | {
        u: kinematics.eliminated_values[place] for place, u in enumerate(kinematics.eliminated)
    }
    fixed = [name for name in written if name in start.fixed and name not in speeds]
    conditions = [
        *kinematics.velocity_constraints,
        *(written[name] - symbol(f"given value of {name}") for name in fixed),
    ]
    is_by_rates = (
        bool(fixed) and any(name in rates for name in fixed) and _has_chosen(kinematics, start.fixed)
    )
    if is_by_rates:
        if any(name in speeds for name in start.guess):
            raise SimulationError(
                f"{_WHERE}: rates are given and speeds are guessed; expected guesses of coordinates alone: the "
                "derivatives of such a start aren't known"
            )
        distances = [value for name, value in written.items() if name in rates and name not in fixed]
    else:
        distances = [name - number(start.guess.get(name, 0.0)) for name in free]
    problem = _Nearest(start, by, free, distances, conditions, tuple(fixed))
    others = [name for name in start.variables if name not in free]
    places = [start.variables.index(name) for name in others]
    found = given[nq : nq + len(speeds)].copy()
    found[[speeds.index(name) for name in free]] = problem.slopes(others, given[places])
    return found


def _has_chosen(kinematics: Kinematics, fixed: Values) -> bool:
    """Return whether there are speeds that are no rates, none of which is given."""
    chosen = {u for u in (*kinematics.system.speeds, *kinematics.system.eliminated) if u.order == 0}
    return bool(chosen) and chosen.isdisjoint(fixed)


@dataclass(frozen=True, eq=False)
class _Nearest:
    """The minimum of ``|d(x)|^2 / 2`` with ``c(x) = 0``, and how it moves with parameters.

    Attributes:
        start: the minimum that was found.
        by: the parameters and given values.
        free: the variables x.
        distances: d.
        conditions: c.
        fixed: rates and eliminated speeds whose given values stand in the conditions.
    """

    start: ConsistentStart
    by: Sequence[Expr]
    free: Sequence[Expr]
    distances: Sequence[Expr]
    conditions: Sequence[Expr]
    fixed: tuple[Expr, ...] = ()

    def slopes(self, others: Sequence[Expr], given: Array) -> Array:
        """Return the derivatives of the free variables, shape (free, k).

        Args:
            others: other variables in the conditions.
            given: their derivatives, shape (others, k).
        """
        if not self.free and not self.conditions:
            return np.zeros((0, len(self.by)))
        stands = {name: symbol(f"given value of {name}") for name in self.fixed}
        parameters = [stands.get(p, p) for p in self.by]
        known = self.start.values | {stands[name]: self.start.fixed[name] for name in self.fixed}
        mu = [symbol(f"multiplier {k + 1} of the start") for k in range(len(self.conditions))]
        with derivation():
            pull, rows = self._pull_and_rows()
            balance = [
                sum((m * row[i] for m, row in zip(mu, rows, strict=True)), start=each)
                for i, each in enumerate(pull)
            ]
            leaves = [*self.free, *mu, *others, *(p for p in parameters if p.kind == "symbol")]
            slopes = jacobian([*balance, *self.conditions], leaves)
        values = {**known, **dict(zip(mu, self._multipliers(pull, rows, known).tolist(), strict=True))}
        found = _numbers([*slopes.entries], values).reshape(slopes.shape)
        return self._solved(found, parameters, given, len(mu))

    def _pull_and_rows(self) -> tuple[list[Expr], list[tuple[Expr, ...]]]:
        """Return the gradient of ``|d|^2 / 2``, and the rows of the Jacobian of the conditions."""
        if not self.free:
            return [], [()] * len(self.conditions)
        square = sum((d * d for d in self.distances), start=number(0)) / 2
        J = jacobian(self.conditions, list(self.free)) if self.conditions else None
        rows = [] if J is None else [tuple(J.row(k)) for k in range(J.rows)]
        return list(gradient(square, list(self.free))), rows

    def _multipliers(self, pull: Sequence[Expr], rows: Sequence[Sequence[Expr]], known: Values) -> Array:
        """Return the multipliers of the minimum.

        Raises:
            SimulationError: the state is not the nearest one.
        """
        if not rows or not self.free:
            return np.zeros(len(rows))
        values = _numbers([*pull, *(entry for row in rows for entry in row)], known)
        force, J = values[: len(pull)], values[len(pull) :].reshape(len(rows), len(pull))
        found, _ = least_norm(J.T, -force)
        left = np.abs(J.T @ found + force).max(initial=0.0)
        if left > ROUNDED * (1 + np.abs(force).max(initial=0.0)):
            raise SimulationError(
                f"{_WHERE}: the initial state satisfies the constraints, but isn't the nearest one to the guess, so "
                "that its derivatives aren't known; give more initial values, or a guess nearer to the state"
            )
        return found

    def _solved(self, slopes: Array, parameters: Sequence[Expr], given: Array, count: int) -> Array:
        """Return the derivatives of the free variables from those of the conditions of the minimum."""
        nf = len(self.free)
        A, of_others = slopes[:, : nf + count], slopes[:, nf + count : nf + count + len(given)]
        right = -(of_others @ given)
        place = nf + count + len(given)
        for column, p in enumerate(parameters):
            if p.kind == "symbol":
                right[:, column] -= slopes[:, place]
                place += 1
        solution, kernel = least_norm(A, right)
        if np.abs(kernel[:nf]).max(initial=0.0) > ROUNDED:
            raise SimulationError(
                f"{_WHERE}: many initial states are equally near to the guess, so that the nearest has no derivatives; "
                "give more initial values"
            )
        left = np.abs(A @ solution - right)
        terms = np.abs(A) @ np.abs(solution) + np.abs(of_others) @ np.abs(given) + np.abs(right)
        size = terms + np.abs(slopes).max(axis=1, initial=0.0)[:, None]
        is_wrong = left > _EXACT * np.where(size > 0, size, 1.0)
        if is_wrong.any():
            names = joined_by_and([str(p) for column, p in enumerate(self.by) if is_wrong[:, column].any()])
            raise ConstraintError(
                f"{_WHERE}: the given initial values satisfy the constraints only for these values of {names}, so that "
                "they have no derivatives; give some of the initial values as a guess instead, so that they are "
                "solved for"
            )
        found: Array = solution[:nf]
        return found


def _numbers(expressions: Sequence[Expr], values: Values) -> Array:
    """Return the values of expressions, shape (n,)."""
    names = sorted(values, key=str)
    return np.array(lambdify(names, expressions)(*(values[name] for name in names)), dtype=float)
