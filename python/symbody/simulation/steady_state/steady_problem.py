"""What is given and what is unknown in a steady motion: names are checked, and sorted by what they are."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from symbody.dynamics import Equations
from symbody.errors import ParameterError, SimulationError
from symbody.simulation.constraint.consistent_position import positions
from symbody.simulation.constraint.kinematics import kinematics_of, neutral_position
from symbody.simulation.constraint.least_norm import least_norm
from symbody.simulation.constraint.opposite_axes import turned_joint
from symbody.simulation.given.given_input import Given
from symbody.simulation.given.odd_values import warn_of_odd_values
from symbody.simulation.given.values import (
    check_equations,
    parameter_values,
)
from symbody.symbolic import Expr, ExprLike, free_symbols, idle_symbols, number, symbol, time_derivative
from symbody.symbolic import t as time
from symbody.symbolic.given.arguments import brief
from symbody.symbolic.given.wording import joined_by_and

from .course import course_of
from .force_balance import Balance
from .steady_conditions import SteadyConditions, conditions_of
from .steady_variables import (
    Kinds,
    Limits,
    Values,
    bounds,
    checked_held,
    checked_unknown,
    inputs_of,
    numbers,
    sorted_by_kind,
)

__all__ = ["Search", "SteadyProblem", "steady_problem"]

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Search:
    """The arguments of `steady`.

    Attributes:
        equations: the equations of motion.
        parameters: values of symbols.
        given: values of variables, and of expressions of the state.
        unknown: parameters and inputs that are solved for.
        guess: values near the steady motion.
        limits: the least and the largest values of unknowns.
        held: coordinates along which forces hold the motion.
        t: the time, in s.
        inputs: expressions of the input functions of time.
        where: the function that the user called, for messages.
        limiting: its argument that gives `limits`.
    """

    equations: Equations
    parameters: Values | None = None
    given: Values | None = None
    unknown: Iterable[Expr] = ()
    guess: Values | None = None
    limits: Limits | None = None
    held: Iterable[Expr] = ()
    t: float = 0.0
    inputs: Mapping[Expr, ExprLike] | None = None
    where: str = "steady"
    limiting: str = "limits"


@dataclass(frozen=True, eq=False)
class SteadyProblem:
    """The conditions of a steady motion, and where to look for it.

    Attributes:
        balance: the conditions.
        start: the variables near which it is, given ones included.
        inputs: the expressions of inputs; a symbol stands for a number, also for one that is unknown.
        parameters: the values of all parameters that the user gave.
        limits: the least and the largest values of the variables, two columns.
        names: the variables; those of inputs by their own names.
        where: the function that the user called, for messages.
    """

    balance: Balance
    start: Array
    names: tuple[Expr, ...]
    inputs: dict[Expr, Expr]
    parameters: dict[Expr, float]
    limits: Array
    where: str

    def freeing(self, x: Array, parameter: Expr) -> tuple[SteadyProblem, Array]:
        """Return the same problem with one given variable, parameter, input or expression unknown, and the variables.

        Args:
            x: the variables.
            parameter: what is given here.

        Raises:
            ParameterError: it is not given.
            SimulationError: other coordinates matter when it changes.
        """
        balance, conditions = self.balance, self.balance.conditions
        if parameter in balance.fixed and parameter not in conditions.course.ignorable:
            fixed = tuple(name for name in balance.fixed if name != parameter)
            return replace(self, balance=replace(balance, fixed=fixed), start=x), x
        symbols = dict(conditions.given) | dict(conditions.prescribed)
        its = symbols.get(parameter, parameter)
        if its not in conditions.parameters:
            raise ParameterError(self._not_given(parameter))
        constants = dict(zip(conditions.parameters, balance.p, strict=True))
        begin = constants.pop(its)
        made = conditions_of(
            conditions.equations,
            conditions.given,
            conditions.course,
            (*conditions.solved, its),
            conditions.prescribed,
        )
        _check_course(made, constants, parameter)
        p = np.array([constants[name] for name in made.parameters])
        x = np.append(x, begin)
        limits = np.vstack([self.limits, [-np.inf, np.inf]])
        names = (*self.names, parameter)
        return SteadyProblem(
            replace(balance, conditions=made, p=p), x, names, self.inputs, self.parameters, limits, self.where
        ), x

    def fixing(self, x: Array, parameter: Expr) -> SteadyProblem:
        """Return the same problem with an unknown given."""
        fixed = (*self.balance.fixed, self.balance.conditions.variables[self.names.index(parameter)])
        return replace(self, balance=replace(self.balance, fixed=fixed), start=x)

    def turned_joint(self, x: Array) -> str:
        """Return which joint is closed with opposite axes at the variables of a solution; the empty text if none is."""
        conditions = self.balance.conditions
        eqs, kinematics = conditions.equations, kinematics_of(conditions.equations, dict(conditions.given))
        values = dict(zip(conditions.parameters, self.balance.p, strict=True))
        values |= dict(zip(conditions.variables, map(float, x), strict=True))
        p = np.array([values[name] for name in kinematics.parameters])
        return turned_joint(
            kinematics, p, self.balance.t, np.array([values.get(q, 0.0) for q in eqs.coordinates])
        )

    def _not_given(self, parameter: Expr) -> str:
        if parameter in self.names and parameter not in self.balance.conditions.course.ignorable:
            return (
                f"continuation: {parameter} is unknown in this steady motion; expected a variable that was given: find "
                f"one with given={{{parameter}: ...}}"
            )
        kept = self.balance.conditions.course.ignorable
        if parameter in kept:
            return f"continuation: nothing depends on {parameter}; expected a variable that was given and that matters"
        given = [
            *(str(name) for name in self.balance.fixed if name in self.names and name not in kept),
            *(str(name) for name, its in self.balance.conditions.given if its.kind == "symbol"),
            *map(str, self.balance.conditions.equations.parameters),
        ]
        return (
            f"continuation: {brief(parameter)} is not given in this steady motion; expected one of "
            f"{joined_by_and(given, most=30, last='or')}"
        )


def _check_course(conditions: SteadyConditions, constants: Mapping[Expr, float], parameter: Expr) -> None:
    """Check that the same coordinates may move when a parameter changes.

    Raises:
        SimulationError: one may move for its value in the steady motion alone.
    """
    found = course_of(conditions.equations, conditions.given, _alike(conditions.equations, constants))
    lost = [q for q in conditions.course.ignorable if q not in found.ignorable]
    if lost:
        raise SimulationError(
            f"continuation: {lost[0]} may move at the given value of {parameter} alone: the equations depend on it "
            f"when {parameter} changes; expected another parameter, or equations in which "
            f"{parameter} is written by others"
        )


def steady_problem(search: Search) -> SteadyProblem:
    """Return the conditions of a steady motion.

    Raises:
        ParameterError: a name is unknown, a value is missing, or a variable is both given and unknown.
        SimulationError: the given values can't be those of a steady motion.
        ConstraintError: no position with the given coordinates satisfies the constraints.
    """
    eqs = search.equations
    where = search.where
    check_equations(eqs, where)
    kinds = Kinds(eqs, where)
    state, expressions, constants, of_inputs = sorted_by_kind(kinds, search.given)
    unknown = checked_unknown(kinds, search.unknown, {*state, *constants, *of_inputs})
    near = numbers(kinds, search.guess, "guess", (*kinds.all, *eqs.system.state_names))
    _check_no_state(kinds, search.parameters)
    constants = numbers(kinds, search.parameters, "parameters", None) | constants
    inputs, stands = inputs_of(kinds, {**(search.inputs or {}), **of_inputs}, unknown)
    values = {symbol_of: near.get(w, value) for w, (symbol_of, value) in stands.items()}
    formulas = {w: stands[w][0] if w in stands else formula for w, formula in inputs.items()}
    given = tuple(sorted(formulas.items(), key=lambda pair: str(pair[0])))
    warn_of_odd_values(eqs, constants, list(inputs.values()), where)

    solved = tuple(stands[name][0] if name in stands else name for name in unknown)
    guessed = {name: near[name] for name in unknown if name in near and name not in stands}
    start = {**constants, **values, **guessed}
    start = dict.fromkeys(solved, 0.0) | start
    prescribed = {e: symbol(f"given value {k + 1}") for k, e in enumerate(expressions)}
    start |= {prescribed[e]: value for e, value in expressions.items()}
    course = course_of(eqs, given, _alike(eqs, {k: v for k, v in start.items() if k not in solved}))
    conditions = conditions_of(eqs, given, course, solved, tuple(prescribed.items()))
    _check_autonomous(conditions, where)
    _check_moving(conditions, state, where)
    p = parameter_values(conditions.parameters, start, where=where, beside=eqs.system.state_names)
    fixed = (*state, *(q for q in course.ignorable if q not in state))
    held = checked_held(kinds, search.held)
    variables = _start(conditions, state, near, start, search)
    names = (*conditions.positions, *course.moving, *unknown)
    limited = bounds(search.limits, names, fixed, f"{where}, {search.limiting}")
    balance = Balance(conditions, search.t, p, tuple(name for name in fixed if name in names), held)
    variables = _with_speeds(balance, variables)
    return SteadyProblem(balance, variables, names, formulas, constants, limited, where)


def _check_no_state(kinds: Kinds, parameters: object) -> None:
    """Check that no values of the state are among those of parameters.

    Raises:
        ParameterError: one is.
    """
    values = parameters if isinstance(parameters, Mapping) else {}
    name = next((name for name in values if isinstance(name, Expr) and name in kinds.state), None)
    if name is not None:
        raise ParameterError(
            f"{kinds.where}, parameters: {name} is a variable of the state; give it in given={{{name}: ...}}, or, to "
            f"begin with, in guess={{{name}: ...}}"
        )


def _alike(eqs: Equations, values: Mapping[Expr, float]) -> Given:
    """Return the parameters that are zero or equal to others, with these."""
    first: dict[float, Expr] = {0.0: number(0)}
    found: list[tuple[Expr, Expr]] = []
    for name in eqs.parameters:
        if name in values:
            same = first.setdefault(values[name], name)
            if same is not name:
                found.append((name, same))
    return tuple(found)


def _check_autonomous(conditions: SteadyConditions, where: str) -> None:
    """Check that the conditions don't depend on the time.

    Raises:
        SimulationError: one does, so that no motion is steady.
    """
    if time not in free_symbols(conditions.expressions) or time in idle_symbols(conditions.expressions):
        return
    name = next(
        name
        for name, each in zip(conditions.names, conditions.expressions, strict=True)
        if time in free_symbols([each]) and time not in idle_symbols([each])
    )
    raise SimulationError(
        f"{where}: {name.rstrip(',')} depends on the time, so that no motion is steady; expected equations without "
        "the time: constant inputs, and frames that are moved by coordinates, whose rates can be given"
    )


def _check_moving(conditions: SteadyConditions, state: Mapping[Expr, float], where: str) -> None:
    """Check that given speeds are not those of coordinates that matter.

    Raises:
        SimulationError: such a coordinate would move, so that the motion is not steady.
    """
    eqs, moving = conditions.equations, conditions.course.moving
    for q in eqs.coordinates:
        rate = time_derivative(q)
        if state.get(rate, 0.0) and rate in eqs.speeds and rate not in moving:
            raise SimulationError(
                f"{where}: {rate} = {state[rate]:.6g} is given, but {_on_it(conditions, q)} on {q}, so that the "
                "motion is not steady: it changes while this coordinate moves; expected rates of coordinates on which "
                f"nothing depends: {joined_by_and([str(u) for u in moving]) if moving else 'there are none here'}"
            )


def _on_it(conditions: SteadyConditions, q: Expr) -> str:
    """Return the first condition whose value depends on a coordinate, as the subject of a sentence."""
    for name, each in zip(conditions.names, conditions.expressions, strict=True):
        if q in free_symbols([each]) and q not in idle_symbols([each]):
            return f"{name.rstrip(',')} depends"
    return "the equations depend"


def _start(
    conditions: SteadyConditions,
    state: Mapping[Expr, float],
    near: Mapping[Expr, float],
    constants: Mapping[Expr, float],
    search: Search,
) -> Array:
    """Return the variables near which the search begins: given, guessed, or on the constraints.

    Args:
        conditions: the conditions of steady motion.
        state: the given coordinates, speeds and states.
        near: the guessed ones.
        constants: the values of all symbols, with those near which unknown ones are.
        search: the arguments of `steady`.
    """
    eqs = conditions.equations
    kinematics = kinematics_of(eqs, dict(conditions.given))
    neutral = dict(zip(eqs.coordinates, neutral_position(eqs.system), strict=True))
    begin = {**neutral, **near, **state, **{s: constants[s] for s in conditions.solved}}
    if not {*conditions.solved} & {*kinematics.parameters}:
        fixed = {q: begin[q] for q in eqs.coordinates if q in state or q in conditions.course.ignorable}
        guessed = {q: begin[q] for q in eqs.coordinates}
        values = np.array([constants[name] for name in kinematics.parameters])
        q = positions(kinematics, values, search.t, fixed, guessed, where=search.where)
        begin |= dict(zip(eqs.coordinates, map(float, q), strict=True))
    return np.array([begin.get(name, 0.0) for name in conditions.variables])


def _with_speeds(balance: Balance, x: Array) -> Array:
    """Return a start with the speeds, nearest to those of the start, that satisfy the constraints on velocities.

    Wheels then roll from the beginning, which spares most steps of the search.
    """
    eqs, conditions = balance.equations, balance.conditions
    n, m = len(eqs.speeds), len(eqs.constraints)
    rows = [n + k for k in range(m) if k not in eqs.system.holonomic]
    speeds = np.array([name in conditions.course.moving for name in conditions.variables], dtype=bool)
    free = speeds & balance.is_free
    F, slopes, _ = balance.values(x, np.zeros(balance.count))
    if not rows or not free.any() or not (np.isfinite(F[rows]).all() and np.isfinite(slopes[rows]).all()):
        return x
    found = x.copy()
    found[free] += least_norm(slopes[rows][:, : len(x)][:, free], -F[rows])[0]
    return found
