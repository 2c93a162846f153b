"""Conditions of steady motion: the equations of motion at zero accelerations, and their derivatives, compiled."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache

from symbody.codegen import CompiledFunction, lambdify
from symbody.dynamics import Equations
from symbody.errors import DivisionByZeroError, ExpressionError, SimulationError
from symbody.multibody.named_constraint import named_constraint
from symbody.simulation.constraint.kinematics import quaternions
from symbody.simulation.constraint.magnitude import MeasuredFunction, measured
from symbody.simulation.given.given_input import Given, substitute_inputs
from symbody.simulation.given.parameter import parameters_among
from symbody.symbolic import (
    Expr,
    free_symbols,
    gradient,
    jacobian,
    number,
    substitute,
    symbol,
    t,
    time_derivative,
)

from .course import REST, Course

__all__ = ["SteadyConditions", "conditions_of"]


@dataclass(frozen=True, eq=False)
class SteadyConditions:
    """The conditions of steady motion ``r(q, u, 0, z, lambda) - K^T h = 0``, ``phi = 0``, ``q' = 0`` and ``z' = 0``.

    r are the residuals of the equations of motion, ``M u' - forcing - phi_q^T lambda``. ``q' = K u + k = 0`` holds for
    coordinates that matter; ignorable ones may move. At rest, all speeds are zero, and so is q'.

    Attributes:
        equations: the equations of motion.
        given: the expressions that replace input functions of time.
        course: which coordinates are let go, and which speeds may differ from zero; none at rest.
        solved: symbols that are unknown beside the state.
        prescribed: expressions of the state with the symbols of their values.
    """

    equations: Equations
    given: Given
    course: Course = REST
    solved: tuple[Expr, ...] = ()
    prescribed: tuple[tuple[Expr, Expr], ...] = ()

    @cached_property
    def parameters(self) -> tuple[Expr, ...]:
        """The symbols that need values, sorted by name."""
        given = free_symbols([value for _, value in self.given])
        wanted = free_symbols([part for pair in self._prescribed for part in pair])
        found = parameters_among({*self.equations.parameters, *given, *wanted})
        return tuple(name for name in found if name not in self.solved)

    @cached_property
    def quaternions(self) -> tuple[tuple[Expr, ...], ...]:
        """The Euler parameters of floating frames, with norm one."""
        found = quaternions(self.equations.system)
        return tuple(four for four in found if not {*four} <= {*self.course.ignorable})

    @property
    def positions(self) -> tuple[Expr, ...]:
        """The coordinates, then the states."""
        return self.equations.coordinates + self.equations.states

    @property
    def variables(self) -> tuple[Expr, ...]:
        """The coordinates and states, then speeds that may differ from zero, then other unknowns."""
        return self.positions + self.course.moving + self.solved

    @cached_property
    def holding(self) -> tuple[Expr, ...]:
        """Symbols for the forces h along the coordinates."""
        return tuple(
            symbol(f"holding {k}") for k in range(len(self.equations.coordinates))
        )  # no user's names

    @cached_property
    def expressions(self) -> tuple[Expr, ...]:
        """Expressions that are zero in steady motion, in the order of `names`.

        Residuals, constraints, norms of quaternions less one, rates of states, rates of coordinates, prescribed values.
        Eliminated constraints on positions follow the others; they have no multipliers.

        Raises:
            SimulationError: one of them is not defined at rest.
        """
        power = sum((h * rate for h, rate in zip(self.holding, self._rates, strict=True)), start=number(0))
        along = gradient(power, self.equations.speeds)
        residuals = [r - h for r, h in zip(self._residuals, along, strict=True)]
        norms = [sum((e * e for e in four), start=number(-1)) for four in self.quaternions]
        differences = [expression - value for expression, value in self._prescribed]
        parts = (*residuals, *self._constraints, *norms, *self._state_rates, *self._drifts, *differences)
        return self._steady(parts)

    @cached_property
    def names(self) -> tuple[str, ...]:
        """What the conditions are called in messages."""
        eqs = self.equations
        whole = eqs.system.whole
        conditions = eqs.system.conditions or [whole.conditions[k] for k in whole.holonomic]
        return (
            *(f"the equation of motion of {name}" for name in eqs.system.driving),
            *(f"constraint {k + 1}, {named_constraint(each)}," for k, each in enumerate(conditions)),
            *(f"the norm of {', '.join(map(str, four))}" for four in self.quaternions),
            *(f"the rate of the state {state}" for state in eqs.states),
            *(f"the rate of the coordinate {q}" for q in self._led),
            *(f"the given value of {expression}" for expression, _ in self.prescribed),
        )

    def written(self, expressions: Sequence[Expr]) -> tuple[Expr, ...]:
        """Return expressions of the model in steady motion, by the variables, multipliers and symbols alone."""
        at_rest = dict.fromkeys((u for u in self.equations.speeds if u not in self.course.moving), number(0))
        values = self._substitute_inputs(expressions)
        values = substitute(substitute(values, self.accelerations), at_rest)
        return self._substitute_inputs(values)

    def _steady(self, expressions: Sequence[Expr]) -> tuple[Expr, ...]:
        """Return expressions at zero accelerations, and at zero speeds unless these may differ from zero."""
        steady = substitute(expressions, self.accelerations)
        at_rest = dict.fromkeys((u for u in self.equations.speeds if u not in self.course.moving), number(0))
        try:
            return substitute(steady, at_rest)
        except (DivisionByZeroError, ExpressionError) as error:
            raise SimulationError(self._undefined(steady, at_rest, str(error))) from error

    def _undefined(self, expressions: Sequence[Expr], at_rest: dict[Expr, Expr], fault: str) -> str:
        place = 0
        while _is_defined(expressions[place], at_rest):
            place += 1
        where, speed = ("steady" if self.course.moving else "equilibrium"), self.equations.speeds[0]
        return (
            f"{where}: {self.names[place].rstrip(',')} is not defined at zero speeds: {fault.partition(';')[0]}; "
            f"expected laws of loads that are: give slips a least speed, such as sqrt({speed}**2 + v0**2) for {speed}, "
            f"or look for a motion at a speed: steady(equations, given={{{speed}: ...}})"
        )

    @cached_property
    def accelerations(self) -> dict[Expr, Expr]:
        """The accelerations: zero, or ``x'' = -psi' y'``, ``y'' = psi' x'`` if velocities turn with a heading psi."""
        found = dict.fromkeys(self.equations.accelerations, number(0))
        if self.course.turning is not None:
            x, y, heading = self.course.turning
            (turn,) = self._substitute_inputs([time_derivative(heading)])
            dx, dy = time_derivative(x), time_derivative(y)
            found |= {time_derivative(dx): -turn * dy, time_derivative(dy): turn * dx}
        return found

    @property
    def _led(self) -> list[Expr]:
        """The coordinates that matter whose rates are not among the speeds, so that a condition keeps them."""
        if not self.course.moving:
            return []
        eqs, kept = self.equations, {*self.course.ignorable}
        return [q for q in eqs.coordinates if q not in kept and time_derivative(q) not in eqs.speeds]

    @property
    def _drifts(self) -> tuple[Expr, ...]:
        rates = dict(zip(self.equations.coordinates, self._rates, strict=True))
        return tuple(rates[q] for q in self._led)

    @property
    def _constraints(self) -> tuple[Expr, ...]:
        kept = (*self.equations.constraints, *self.equations.system.eliminated_constraints)
        return self._substitute_inputs(kept)

    @cached_property
    def _prescribed(self) -> list[tuple[Expr, Expr]]:
        expressions = self._substitute_inputs([expression for expression, _ in self.prescribed])
        return list(zip(expressions, [value for _, value in self.prescribed], strict=True))

    @cached_property
    def giving_rates(self) -> list[int]:
        """The places of the constraints on velocities that depend on the position or on states at rest."""
        n, eqs = len(self.equations.speeds), self.equations
        on_velocities = [k for k in range(len(eqs.constraints)) if k not in eqs.system.holonomic]
        return [k for k in on_velocities if free_symbols([self.expressions[n + k]]) & {*self.positions}]

    @cached_property
    def function(self) -> MeasuredFunction:
        """The function of t, the variables, lambda, h and p: the conditions, their slopes, and term magnitudes."""
        unknowns = [[*self.variables], [*self.equations.multipliers], [*self.holding]]
        slopes = jacobian(list(self.expressions), [name for names in unknowns for name in names])
        outputs = [list(self.expressions), slopes]
        return measured([t, *unknowns, list(self.parameters)], outputs, self.expressions)

    @cached_property
    def small_motion(self) -> CompiledFunction:
        """The function of t, (q, z), lambda and p that returns M, ``dr/du``, ``dq'/du``, ``dz'/d(u, u')`` at rest."""
        eqs = self.equations
        at_rest = dict.fromkeys((*eqs.accelerations, *eqs.speeds), number(0))
        inertia = jacobian(list(self._residuals), list(eqs.accelerations)).subs(at_rest)
        damping = jacobian(list(self._residuals), list(eqs.speeds)).subs(at_rest)
        rates = jacobian(list(self._rates), list(eqs.speeds))
        variables: list[Expr | list[Expr]] = [
            t,
            list(self.positions),
            list(eqs.multipliers),
            list(self.parameters),
        ]
        driving = jacobian(list(self._state_rates), [*eqs.speeds, *eqs.accelerations]).subs(at_rest)
        return lambdify(variables, [inertia, damping, rates, driving])

    @cached_property
    def _rates(self) -> tuple[Expr, ...]:
        return self._substitute_inputs(tuple(self.equations.kinematics.values()))

    @cached_property
    def _state_rates(self) -> tuple[Expr, ...]:
        return self._substitute_inputs(tuple(self.equations.state_rates.values()))

    @cached_property
    def _residuals(self) -> tuple[Expr, ...]:
        return self._substitute_inputs(self.equations.derived_residuals)

    def _substitute_inputs(self, expressions: Sequence[Expr]) -> tuple[Expr, ...]:
        return substitute_inputs(self.equations.system, self.given, tuple(expressions))


def _is_defined(expression: Expr, values: Mapping[Expr, Expr]) -> bool:
    try:
        substitute([expression], values)
    except (DivisionByZeroError, ExpressionError):
        return False
    return True


@lru_cache(maxsize=32)
def conditions_of(
    eqs: Equations,
    given: Given,
    course: Course = REST,
    solved: tuple[Expr, ...] = (),
    prescribed: tuple[tuple[Expr, Expr], ...] = (),
) -> SteadyConditions:
    """Return the conditions of steady motion. They are cached, with their compiled code.

    Args:
        eqs: the equations of motion.
        given: the expressions that replace input functions of time.
        course: which coordinates are let go.
        solved: symbols that are unknown beside the state.
        prescribed: expressions of the state with the symbols of their values.
    """
    return SteadyConditions(eqs, given, course, solved, prescribed)
