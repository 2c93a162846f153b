"""The functions that a simulation evaluates: expressions of time, state and parameters, and their machine code."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace
from functools import cached_property, lru_cache

from symbody.codegen import PreparedCode, Shortcut, lambdify
from symbody.dynamics import Equations, ForwardDynamics, forward_dynamics
from symbody.errors import ModelError
from symbody.multibody import System, Variables
from symbody.simulation.given.given_input import substitute_inputs
from symbody.simulation.given.parameter import parameters_among, parameters_in
from symbody.symbolic import (
    Expr,
    ExprLike,
    cost,
    derivation,
    free_symbols,
    number,
    substitute,
    symbols,
    t,
    without_idle_symbols,
)
from symbody.symbolic import jacobian as jacobian_of

from .constraint_correction import ConstraintCorrection, constraint_correction
from .drive import does_uncounted_work, names_of_drives
from .energy_balance import energies_of, energies_of_bodies, power_of_loads
from .motion_function import MotionFunction

__all__ = ["DAMPING", "Model", "model_of", "with_equations", "without_stabilization"]

DAMPING = symbols("baumgarte_omega baumgarte_zeta")
"""The parameters of Baumgarte's stabilisation; their values are chosen when a motion begins."""

Inputs = Mapping[Expr, ExprLike]

_MOST_FREEDOM = 20
"""The largest number of independent speeds for which a shortcut is derived: its mass matrix is full."""

_LONGEST, _SHORTER = 5000, 0.9
"""The most operations of a shortcut, and the most relative to the general solution."""


@dataclass(frozen=True, eq=False)
class Model:
    """The functions that all simulations of a system share. Each is derived and compiled on first use.

    The state is ``(q, u, z)``: coordinates, speeds, and the states beside the mechanics. Where loads or moving
    constraints do work, it is followed by that work, whose rate is ``dE/dt``, so that the balance of energy can be
    checked along any motion.

    Attributes:
        equations: the equations of motion.
        inputs: the expressions that replace input functions of time.
        is_stabilized: whether Baumgarte's stabilisation enforces the constraints.
        method: how the accelerations are solved for, as in `forward_dynamics`.
    """

    equations: Equations
    inputs: tuple[tuple[Expr, Expr], ...] = ()
    is_stabilized: bool = False
    method: str = "auto"
    _functions: dict[tuple[tuple[Expr, ...], ...], MotionFunction] = field(default_factory=dict, repr=False)

    @property
    def system(self) -> Variables:
        """The system that moves."""
        return self.equations.system

    @cached_property
    def coordinates(self) -> tuple[Expr, ...]:
        """The coordinates q."""
        return self.equations.coordinates

    @cached_property
    def speeds(self) -> tuple[Expr, ...]:
        """The speeds u."""
        return self.equations.speeds

    @cached_property
    def state(self) -> tuple[Expr, ...]:
        """The coordinates, the speeds and the states z, without the work; their number is n."""
        return self.coordinates + self.speeds + self.states

    @property
    def states(self) -> tuple[Expr, ...]:
        """The states z beside the mechanics."""
        return self.equations.states

    @cached_property
    def state_rates(self) -> tuple[Expr, ...]:
        """The rates of the states z, which may contain accelerations and multipliers."""
        return tuple(self.equations.state_rates.values())

    @cached_property
    def accelerations(self) -> tuple[Expr, ...]:
        """The rates of the speeds."""
        return self.equations.accelerations

    @cached_property
    def multipliers(self) -> tuple[Expr, ...]:
        """The multipliers of the constraints; without redundant ones, not those of the user, which all share."""
        return self.equations.multipliers

    @cached_property
    def constraints(self) -> tuple[Expr, ...]:
        """The constraints, expressions that are zero: phi on positions, or ``A u + b`` on velocities."""
        return self.equations.constraints

    @cached_property
    def position_constraints(self) -> tuple[Expr, ...]:
        """The constraints phi on positions."""
        return tuple(self.constraints[k] for k in self.system.holonomic)

    @cached_property
    def velocity_constraints(self) -> tuple[Expr, ...]:
        """The constraints on the level of velocities, ``A u + b``, one each."""
        return self.system.velocity_level(self.constraints)

    @cached_property
    def independent_constraints(self) -> int:
        """The number of constraints that are independent at almost every position."""
        return self.equations.constraint_jacobian.rank()

    @cached_property
    def parameters(self) -> tuple[Expr, ...]:
        """The symbols that need values, sorted by name: those of the equations and of the inputs."""
        given = free_symbols([value for _, value in self.inputs])
        return parameters_among({*self.equations.parameters, *given})

    @property
    def damping(self) -> tuple[Expr, ...]:
        """The frequency and the damping ratio of Baumgarte's stabilisation; empty without it."""
        return DAMPING if self.is_stabilized else ()

    @cached_property
    def solution(self) -> ForwardDynamics:
        """The accelerations and multipliers as functions of time, state and parameters."""
        return self._solved(self.method)

    @cached_property
    def shortcut(self) -> ForwardDynamics | None:
        """The same by independent speeds, if that code is short enough; accurate where its conditions are positive.

        A linear system that is solved at run time takes no time to compile, so its replacement must be short.
        """
        if self.solution.method != "schur_complement" or self._freedom > _MOST_FREEDOM:
            return None
        with suppress(ModelError):
            brief = self._solved("null_space")
            operations, others = (cost(self.rates_with(way)).total for way in (brief, self.solution))
            if operations <= min(_SHORTER * others, _LONGEST):
                return brief
        return None

    @property
    def _freedom(self) -> int:
        return len(self.speeds) - self.independent_constraints

    def _solved(self, method: str) -> ForwardDynamics:
        damping = DAMPING if self.is_stabilized else None
        found = forward_dynamics(self.equations, method=method, baumgarte=damping)
        return replace(
            found,
            accelerations=self.with_inputs(found.accelerations),
            multipliers=self.with_inputs(found.multipliers),
            conditions=self.with_inputs(found.conditions),
        )

    @cached_property
    def equation_names(self) -> list[str]:
        """The names of the rows of the linear system that is solved at run time."""
        return list(self.solution.equation_names)

    @property
    def equations_together(self) -> str:
        """What these rows are called together in messages."""
        return self.solution.equations_together

    @cached_property
    def coordinate_rates(self) -> tuple[Expr, ...]:
        """The rates of the coordinates as functions of the speeds."""
        return tuple(self.equations.kinematics.values())

    @cached_property
    def power(self) -> Expr | None:
        """The power of loads and moving constraints, with accelerations and multipliers.

        What springs and other loads take from their potential energy isn't part of it. None if nothing does work, no
        energy is known, or loads on what has a given motion depend on parameters that the equations don't contain.
        """
        if not self.energies:
            return None
        with derivation():
            total = power_of_loads(self.system) if isinstance(self.system, System) else number(0)
        if self.constraints:
            at_rest = dict.fromkeys(self.speeds, number(0))
            drifts = substitute(self.velocity_constraints, at_rest)
            for multiplier, drift in zip(self.multipliers, drifts, strict=True):
                total -= multiplier * drift
        (total,) = without_idle_symbols([total])  # idle symbols have no values where the equations lack them
        is_known = {*parameters_in([total])} <= {*self.parameters}
        return total if is_known and not total.is_zero else None

    @cached_property
    def rates(self) -> tuple[Expr, ...]:
        """The rates of the coordinates, of the speeds, of the states z, and of the work."""
        return self.rates_with(self.solution)

    def rates_with(self, solution: ForwardDynamics) -> tuple[Expr, ...]:
        """Return the same with given accelerations and multipliers."""
        work = () if self.power is None else (self.power,)
        along = self._along(solution, (*self.state_rates, *work))
        return (*self.with_inputs(self.coordinate_rates), *solution.accelerations, *along)

    @property
    def width(self) -> int:
        """The length of the vector that is integrated."""
        return len(self.state) + (self.power is not None)

    @cached_property
    def energies(self) -> tuple[Expr, ...]:
        """The kinetic energy, and the potential energy of loads, and of weight where the height is known.

        Of equations that were given without bodies, the given energy; nothing if none was given.
        """
        system = self.system
        if not isinstance(system, System):
            return () if self.equations.energy is None else self.with_inputs([self.equations.energy])
        return without_idle_symbols(self.with_inputs(energies_of(system)))

    @property
    def prescribed(self) -> list[str]:
        """The names of what moves bodies or gravity without a coordinate; the power of loads knows theirs."""
        if not isinstance(self.system, System):
            leaves = free_symbols(self.energies)
            return sorted(str(leaf) for leaf in leaves if leaf.depends_on_time and leaf not in self.state)
        energies = substitute(energies_of_bodies(self.system), dict(self.inputs))
        known = {*self.state, *self.system.kinematics, *self.system.eliminated}
        led = {str(leaf) for leaf in free_symbols(energies) if leaf.depends_on_time and leaf not in known}
        return sorted(led) or (list(names_of_drives(self.system)) if self.is_driven else [])

    def with_inputs(self, expressions: Sequence[Expr]) -> tuple[Expr, ...]:
        """Substitute the inputs in expressions, and the rates of coordinates as functions of the speeds."""
        return substitute_inputs(self.system, self.inputs, expressions)

    def along_motion(
        self, expressions: Sequence[Expr], solution: ForwardDynamics | None = None
    ) -> tuple[Expr, ...]:
        """Substitute the accelerations and multipliers that the equations of motion give.

        Higher rates are derivatives of these along the motion; each substitution lowers their order by one.

        Args:
            expressions: the expressions.
            solution: the accelerations and multipliers; those of the general solution by default.
        """
        values = self.with_inputs(expressions)
        for _ in range(self._rates_above_state(values)):
            values = self.with_inputs(self._along(solution or self.solution, values))
        return values

    def code_along_motion(self, expressions: Sequence[Expr]) -> PreparedCode:
        """Return the machine code of expressions along motions, which may have parameters of their own.

        Accelerations and multipliers have the shortcut of the rates, if it isn't longer: it can be run in lanes.
        """
        values, brief = self.along_motion(expressions), self.shortcut
        known = (*self.parameters, *self.damping)
        others = [name for name in parameters_in(values) if name not in known]
        if brief is None or not self._rates_above_state(self.with_inputs(expressions)):
            return self.code(values, others)
        quick = self.along_motion(expressions, brief)
        is_short = cost([*quick, *brief.conditions]).total <= min(cost(values).total, _LONGEST)
        return self.code(values, others, Shortcut(quick, brief.conditions) if is_short else None)

    def _rates_above_state(self, expressions: Sequence[Expr]) -> int:
        """Return the order of the highest rates: 1 for accelerations and multipliers, 0 without any."""
        first = {unknown.name: unknown.order for unknown in (*self.accelerations, *self.multipliers)}
        functions = (leaf for leaf in free_symbols(list(expressions)) if leaf.kind == "time_function")
        return max((leaf.order - first[leaf.name] + 1 for leaf in functions if leaf.name in first), default=0)

    def _along(self, solution: ForwardDynamics, expressions: Sequence[Expr]) -> tuple[Expr, ...]:
        values = {
            **dict(zip(self.accelerations, solution.accelerations, strict=True)),
            **dict(zip(self.multipliers, solution.multipliers, strict=True)),
        }
        return substitute(self.with_inputs(expressions), values)

    @cached_property
    def code_variables(self) -> tuple[Expr, ...]:
        """The variables of compiled code: time, the state, and the work, on which nothing depends."""
        return (t, *self.state, *([_WORK] if self.power is not None else []))

    def code(
        self, expressions: Sequence[Expr], more: Sequence[Expr] = (), shortcut: Shortcut | None = None
    ) -> PreparedCode:
        """Return the machine code of expressions of time and state; it may take more parameters than the equations."""
        parameters = (*self.parameters, *self.damping, *more)
        return PreparedCode(parameters, self.code_variables, tuple(expressions), shortcut)

    @cached_property
    def rates_code(self) -> PreparedCode:
        """The machine code of the rates."""
        brief = self.shortcut
        shortcut = None if brief is None else Shortcut(self.rates_with(brief), brief.conditions)
        return self.code(self.rates, shortcut=shortcut)

    @cached_property
    def energies_code(self) -> PreparedCode | None:
        """The machine code of the kinetic and the potential energy; None where their sum less the work varies.

        The work of prescribed motions is not known, nor the height of a system that a moving frame carries, nor how a
        given energy is divided.
        """
        if not isinstance(self.system, System):
            return None
        energies = [*self.energies, number(0)][:2]
        is_carried = self.system.gravity is not None and self.system.root.carrier is not None
        if is_carried or self.is_driven or not free_symbols(energies) <= {t, *self.parameters, *self.state}:
            return None
        return self.code(energies)

    @cached_property
    def is_driven(self) -> bool:
        """Whether something is led by a force whose work the equations don't contain, so that the energy varies."""
        return isinstance(self.system, System) and does_uncounted_work(
            self.system, self.speeds, self.with_inputs, self.velocity_constraints
        )

    @cached_property
    def correction_codes(self) -> tuple[PreparedCode, PreparedCode]:
        """The machine code of the corrections."""
        change = self._correction(self.solution.method)
        if self.shortcut is None:
            return self.code(change.coordinates), self.code(change.speeds)
        brief = self._correction(self.shortcut.method)
        return (
            self.code(change.coordinates, shortcut=Shortcut(brief.coordinates, brief.conditions)),
            self.code(change.speeds, shortcut=Shortcut(brief.speeds, brief.conditions)),
        )

    def _correction(self, method: str) -> ConstraintCorrection:
        change = constraint_correction(self.equations, method)
        return ConstraintCorrection(
            *map(self.with_inputs, (change.coordinates, change.speeds, change.conditions))
        )

    @cached_property
    def jacobian_code(self) -> tuple[PreparedCode, list[tuple[int, int]]]:
        """The machine code of the nonzero derivatives of the rates, and their rows and columns."""
        slopes = jacobian_of(list(self.rates), list(self.state))
        rows, columns = slopes.shape
        places = [(i, j) for i in range(rows) for j in range(columns) if not slopes[i, j].is_zero]
        return self.code([slopes[place] for place in places]), places

    def unknowns_in(self, expressions: Sequence[Expr]) -> tuple[Expr, ...]:
        """Return the accelerations and multipliers in expressions; none if these contain higher rates."""
        found = free_symbols(self.with_inputs(expressions))
        unknowns = (*self.accelerations, *self.multipliers)
        if any(leaf.depends_on_time for leaf in found - {*self.code_variables, *unknowns}):
            return ()
        return tuple(name for name in unknowns if name in found)

    def function(
        self, expressions: Sequence[Expr], parameters: tuple[Expr, ...], known: tuple[Expr, ...] = ()
    ) -> MotionFunction:
        """Return a function of time, state and parameters that evaluates expressions along motions.

        Args:
            expressions: the expressions.
            parameters: the parameters, which are its last arguments.
            known: accelerations and multipliers whose values are arguments before these, so that it does not solve
                for them.
        """
        key = (tuple(expressions), parameters, known)
        if key not in self._functions:
            values = list((self.with_inputs if known else self.along_motion)(key[0]))
            arguments = [t, *self.state, *known, *parameters]
            self._functions[key] = MotionFunction(
                lambdify(arguments, values), tuple(self.equation_names), self.equations_together
            )
        return self._functions[key]


_WORK = symbols("work_of_loads")
"""The variable of the work in compiled code."""


@lru_cache(maxsize=32)
def _model(
    eqs: Equations, inputs: tuple[tuple[Expr, Expr], ...], *, is_stabilized: bool, method: str
) -> Model:
    return Model(eqs, inputs, is_stabilized, method)


def model_of(
    eqs: Equations,
    inputs: Inputs | None = None,
    *,
    is_stabilized: bool = False,
    zeros: Collection[Expr] = (),
) -> Model:
    """Return the model of equations with given inputs. It is cached, with its compiled code.

    Args:
        eqs: the equations of motion.
        inputs: the expressions that replace input functions of time.
        is_stabilized: whether Baumgarte's stabilisation enforces the constraints.
        zeros: parameters whose value is zero. If they leave coordinates without mass, which only constraints may
            determine, the mass matrix is not eliminated.
    """
    given = tuple(
        sorted(((key, number(value)) for key, value in (inputs or {}).items()), key=lambda pair: str(pair[0]))
    )
    method = "pivoted" if _is_massless(eqs, zeros) else "auto"
    return _model(eqs, given, is_stabilized=is_stabilized, method=method)


def without_stabilization(model: Model) -> Model:
    """Return the same model without Baumgarte's stabilisation."""
    return _model(model.equations, model.inputs, is_stabilized=False, method=model.method)


def with_equations(model: Model, equations: Equations) -> Model:
    """Return the same model of other equations, which may have no constraints left to stabilise."""
    is_stabilized = model.is_stabilized and bool(equations.constraints)
    return _model(equations, model.inputs, is_stabilized=is_stabilized, method=model.method)


def _is_massless(eqs: Equations, zeros: Collection[Expr]) -> bool:
    M = eqs.mass_matrix
    vanishing = {zero: number(0) for zero in zeros if zero in eqs.parameters}
    return bool(eqs.constraints and vanishing) and M.rank() == M.rows != M.subs(vanishing).rank()
