"""Inverse dynamics: the loads that make a system follow a prescribed motion."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import partial
from typing import NoReturn

import numpy as np
from numpy.typing import ArrayLike, NDArray

from symbody.codegen import lambdify
from symbody.dynamics import Equations
from symbody.errors import ArgumentError, ModelError, SimulationError
from symbody.multibody import Variables
from symbody.multibody.joint.freedom import Freedom
from symbody.simulation.constraint.kinematics import Kinematics, kinematics_of
from symbody.simulation.constraint.least_norm import inverse_and_kernel
from symbody.simulation.constraint.shared_load import shared_load
from symbody.simulation.given.given_input import substitute_inputs
from symbody.simulation.given.odd_values import warn_of_odd_values
from symbody.simulation.given.parameter import parameters_among
from symbody.simulation.given.values import given_inputs, state_values
from symbody.simulation.given.watched_limit import tell_passed_limits
from symbody.simulation.model.unknown import unknown_variables
from symbody.simulation.motion.continuous_angle import values_along
from symbody.simulation.motion.motion import Motion
from symbody.simulation.motion.range_table import range_table
from symbody.simulation.motion.reading import Reading
from symbody.symbolic import Expr, ExprLike, free_symbols
from symbody.symbolic import t as symbolic_time
from symbody.symbolic.given.arguments import counted, described, with_known_names
from symbody.symbolic.given.namesake import namesake_note
from symbody.symbolic.numeric.deficiency import reporting

from .driven_motion import prescribed_motion, simulated_motion
from .driving_load import driving_loads
from .limited_drive import limited_drives, tell_passed_efforts
from .states_along import Beside, StateRates, state_rates

__all__ = ["InverseDynamics", "inverse_dynamics"]

Array = NDArray[np.float64]

_WHERE = "inverse_dynamics"

_READING = Reading(
    "result",
    "result.t has the instants, and result.coordinates, result.speeds and result.accelerations have a row for each",
)


@dataclass(frozen=True, eq=False)
class InverseDynamics:
    """A prescribed motion and its loads; ``result[expression]`` has the values of any expression.

    Expressions may contain time, coordinates, speeds, accelerations, multipliers, parameters, and the loads that were
    solved for: for example reaction forces or powers. In the shapes below, N is the number of instants. The order of
    columns is that in the system, and the units are those of the model.

    Attributes:
        system: the system.
        t: the instants, shape (N,), in s.
        coordinates: the coordinates, shape (N, number of coordinates).
        speeds: the speeds u, shape (N, number of speeds).
        accelerations: the rates u' of the speeds, shape (N, number of speeds).
        forces: the loads that were solved for, shape (N,) each; the keys of generalised forces are coordinates.
        multipliers: the multipliers of the constraints, shape (N, number of constraints); those of minimum norm if
            constraints are dependent.
        states: the states beside the mechanics that were integrated, shape (N,) each.
        parameters: the values of the parameters.
        inputs: the expressions that replaced input functions of time.

    >>> from symbody import Body, System, functions_of_time, newton_euler, symbols, t, translate
    >>> x, m = functions_of_time("x"), symbols("m")
    >>> cart = newton_euler(System([Body(translate(x, 0, 0), m)], coordinates=[x]))
    >>> result = inverse_dynamics(cart, {x: 3 * t**2}, {m: 2}, t=[0.0, 0.5, 1.0])
    >>> result[m * x.diff(t, 2) / 2]
    array([6., 6., 6.])
    """

    system: Variables
    t: Array
    coordinates: Array
    speeds: Array
    accelerations: Array
    forces: Mapping[Expr, Array]
    multipliers: Array
    parameters: Mapping[Expr, float]
    inputs: Mapping[Expr, Expr] = field(default_factory=dict)
    states: Mapping[Expr, Array] = field(default_factory=dict)

    def __repr__(self) -> str:
        names = ", ".join(map(str, self.forces)) or "multipliers"
        return f"InverseDynamics of {names}: {counted(len(self.t), 'instant')} from {self.t[0]:g} to {self.t[-1]:g} s"

    def _repr_html_(self) -> str:
        """Return the ranges of the loads that were solved for, of the motion, and of the multipliers."""
        system = self.system
        names = [*system.coordinates, *system.speeds, *self.states, *system.multipliers]
        columns = [*self.coordinates.T, *self.speeds.T, *self.states.values(), *self.multipliers.T]
        loads = [(_name_of_load(load, system), values) for load, values in self.forces.items()]
        return range_table(str(self), "quantity", [*loads, *zip(names, columns, strict=True)])

    def __len__(self) -> int:
        """Return the number of instants."""
        return len(self.t)

    def __iter__(self) -> NoReturn:
        """Refuse to iterate: Python would ask for ``result[0]``, ``result[1]`` and so on."""
        _READING.refuse_iteration()

    def __getitem__(self, expression: Expr | Freedom) -> Array:
        """Return the values of an expression, shape (N,), or of a freedom of a joint, as `Motion` does.

        Raises:
            ArgumentError: the argument is not an expression, or is a number.
            SimulationError: the expression contains a variable without values.
        """
        if isinstance(expression, Freedom):
            return values_along(expression, self.t, self.evaluate, "result")
        values: Array = self.evaluate([_READING.one_expression(expression, self.system.coordinates)])[0]
        return values

    @with_known_names
    def evaluate(self, expressions: Sequence[ExprLike]) -> Array:
        """Return the values of several expressions, one row for each: shape (expressions, N).

        Raises:
            ArgumentError: the argument is not a list of expressions.
            SimulationError: an expression contains a variable without values.
        """
        system = self.system
        asked = _READING.several_expressions(expressions)
        wanted = self._by_state(asked)
        states = [*system.coordinates, *system.speeds, *system.accelerations, *system.multipliers]
        own = {*system.coordinates, *system.driving}
        loads = {name: values for name, values in self.forces.items() if name not in own} | dict(self.states)
        self._check_known(asked, {symbolic_time, *states, *loads, *self.parameters})
        function = lambdify([symbolic_time, states, list(loads), list(self.parameters)], list(wanted))
        rows = np.hstack([self.coordinates, self.speeds, self.accelerations, self.multipliers]).T
        forces = np.array(list(loads.values())).reshape(len(loads), len(self))
        with reporting(_WHERE):
            return np.asarray(function(self.t, rows, forces, _column(self.parameters.values())))

    def _by_state(self, expressions: Sequence[Expr]) -> tuple[Expr, ...]:
        return substitute_inputs(self.system, tuple(self.inputs.items()), expressions)

    def _check_known(self, asked: Sequence[Expr], known: set[Expr]) -> None:
        strange = [leaf for leaf in free_symbols(asked) if not free_symbols(self._by_state([leaf])) <= known]
        if strange:
            loads = ", and of the loads that were solved for"
            note = namesake_note(strange, known, ("asked for", "of the motion"))
            raise SimulationError(unknown_variables(_WHERE, strange, self.system, loads) + note)


def _check_speeds(eqs: object) -> None:
    """Check that the speeds are no momenta."""
    if isinstance(eqs, Equations) and eqs.system.momenta:
        raise ModelError(
            f"{_WHERE}: the speeds of the equations are momenta, along which no forces act; expected equations in "
            "speeds, such as newton_euler(system)"
        )


def _column(values: Iterable[float]) -> Array:
    return np.array(list(values), dtype=np.float64).reshape(-1, 1)


def _name_of_load(load: Expr, system: Variables) -> str:
    """Return the name of a load that was solved for; a generalised force has that of its coordinate."""
    return f"generalised force of {load}" if load in system.coordinates else str(load)


@with_known_names
def inverse_dynamics(
    eqs: Equations,
    motion: Mapping[Expr, ExprLike | ArrayLike] | Motion,
    parameters: Mapping[Expr, ArrayLike] | None = None,
    t: ArrayLike | None = None,
    *,
    unknowns: Sequence[Expr] | None = None,
    inputs: Mapping[Expr, ExprLike] | None = None,
    guess: Mapping[Expr, ArrayLike] | None = None,
    initial: Mapping[Expr, ArrayLike] | None = None,
) -> InverseDynamics:
    """Return the loads that make a system follow a prescribed motion.

    The coordinates that are not prescribed follow from the constraints, with their velocities and accelerations. Then
    ``M u' - forcing - phi_q^T lambda - K^T f = 0`` is linear in lambda and in the forces f along the prescribed
    coordinates, or in the loads given as unknowns [Nikravesh 1988, sec. 5.5]. States beside the mechanics are
    integrated along the motion, unless they are unknowns.

    Args:
        eqs: the equations of motion.
        motion: for each prescribed coordinate an expression of time and parameters, a number, or a row of samples, one
            for each instant. Or a simulated motion: its parameters and inputs are used unless others are given.
        parameters: the values of all symbols, except the unknowns.
        t: the first and the last instant (1001 evenly spaced instants), or all instants, in s.
        unknowns: the symbols or functions of time in the loads that are solved for. By default, a generalised force
            along each prescribed coordinate, or each speed of a simulated motion, acts in addition to the loads. With
            an empty list, the multipliers alone balance the loads, as along a motion of `embedded` equations. A state
            that is solved for does not follow its rate. The effort of a motor with a limit is computed without the
            limit, and a notice reports where it exceeds the limit.
        inputs: expressions of time and state for the input functions of time.
        guess: coordinates near the first position, if they are not prescribed.
        initial: the values of states at the first instant, zero by default; a simulated motion has its own.

    Raises:
        SimulationError: the motion or the loads are not determined, or no loads balance the equations.
        ConstraintError: the constraints do not allow the motion.
        ModelError: a prescription or an unknown is not allowed.
        ParameterError: a value is missing, has an unknown key, or is not finite.

    >>> from symbody import Body, System, functions_of_time, newton_euler, symbols, translate
    >>> from symbody import t as time
    >>> x, m = functions_of_time("x"), symbols("m")
    >>> eqs = newton_euler(System([Body(translate(x, 0, 0), m)], coordinates=[x]))
    >>> inverse_dynamics(eqs, {x: time**2}, {m: 3}, [0, 1, 2]).forces
    {x: array([6., 6., 6.])}
    """
    _check_speeds(eqs)
    loads = _listed(unknowns)
    given = _inputs(eqs, motion, inputs, loads)
    kinematics = kinematics_of(eqs, given)
    _check_unknowns(eqs, kinematics, motion, loads)
    needed = _parameters(eqs, kinematics) - {*loads}
    numbers = _without(parameters, loads)
    rates = state_rates(eqs, kinematics.given, tuple(z for z in eqs.states if z not in loads), loads)
    with reporting(_WHERE):
        if isinstance(motion, Motion):
            _check_left_out(t=t, guess=guess, initial=initial)
            driven = simulated_motion(kinematics, motion, needed, numbers, rates)
        else:
            beside = partial(_beside, rates, initial)
            driven = prescribed_motion(kinematics, motion, t, needed, numbers, guess, beside)
    formulas = (
        [value for value in motion.values() if isinstance(value, Expr)] if isinstance(motion, Mapping) else []
    )
    warn_of_odd_values(eqs, numbers, [*given.values(), *formulas], _WHERE)
    along = driven.driving if unknowns is None else ()
    equations = driving_loads(eqs, kinematics.given, along, loads, _WHERE)
    with reporting(_WHERE):
        forces, multipliers, determined = equations.solution(
            driven.instants, driven.trajectory, driven.parameters
        )
    positions = dict(zip(eqs.coordinates, driven.trajectory.coordinates.T, strict=True))
    if not isinstance(motion, Motion):  # a simulation has told it
        known = {**driven.parameters, **positions, symbolic_time: driven.instants}
        tell_passed_limits(eqs.system, known, given, _WHERE)
    found = InverseDynamics(
        eqs.system,
        driven.instants,
        driven.trajectory.coordinates,
        driven.trajectory.speeds,
        driven.trajectory.accelerations,
        dict(zip(equations.names, forces.T, strict=True)),
        multipliers,
        {name: value for name, value in driven.parameters.items() if name not in loads},
        given,
        dict(zip(rates.states, driven.trajectory.states.T, strict=True)),
    )
    if not determined.all():
        found = _shared(found)
    tell_passed_efforts(limited_drives(eqs.system, loads), found.t, found.evaluate, _WHERE)
    return found


def _shared(found: InverseDynamics) -> InverseDynamics:
    """Return the same with the multipliers of dependent constraints of which joints bear the least."""
    system, count = found.system, len(found)
    gradients = found.evaluate(system.velocity_gradients.entries)
    A = np.moveaxis(gradients.reshape(len(system.multipliers), len(system.speeds), count), -1, 0)
    free = [inverse_and_kernel(each.T)[1] for each in A]
    return replace(found, multipliers=shared_load(system, found.multipliers, free, found.evaluate))


def _beside(
    rates: StateRates,
    initial: Mapping[Expr, ArrayLike] | None,
    prescribed: tuple[Expr, ...],
    values: Mapping[Expr, float],
) -> Beside | None:
    """Return the states beside a prescribed motion; None if there are none to be integrated.

    Args:
        rates: the rates of the states.
        initial: the values of states at the first instant.
        prescribed: the coordinates that are prescribed.
        values: the values of the parameters.
    """
    start = state_values(rates.equations.system, initial, where=_WHERE, argument="initial", kept=rates.states)
    if not rates.states:
        return None
    along = () if rates.loads else prescribed
    equations = driving_loads(rates.equations, rates.given, along, rates.loads, _WHERE)
    m = len(along)

    def forces(time: float, motion: Array) -> Array:
        loads, multipliers = equations.at(time, motion, values)
        return np.concatenate([loads[m:], multipliers])

    return Beside(
        rates,
        np.array([start.get(z, 0.0) for z in rates.states]),
        np.array([values[name] for name in rates.parameters]),
        forces,
    )


def _listed(unknowns: Sequence[Expr] | None) -> tuple[Expr, ...]:
    if unknowns is None:
        return ()
    if not (isinstance(unknowns, list | tuple) and all(isinstance(name, Expr) for name in unknowns)):
        raise ArgumentError(
            f"{_WHERE}, unknowns: {described(unknowns)}; expected a list of symbols or functions of time"
        )
    return tuple(unknowns)


def _inputs(
    eqs: Equations, motion: object, inputs: Mapping[Expr, ExprLike] | None, loads: Sequence[Expr]
) -> dict[Expr, Expr]:
    """Return the inputs: those that are given, or those of a simulated motion."""
    functions = [name for name in loads if name.kind == "time_function"]
    given = inputs
    if isinstance(motion, Motion) and (inputs is None or isinstance(inputs, Mapping)):
        given = {name: value for name, value in motion.model.inputs if name not in loads} | dict(inputs or {})
    return given_inputs(eqs, given, where=_WHERE, besides=functions)


def _parameters(eqs: Equations, kinematics: Kinematics) -> set[Expr]:
    """Return the symbols in the equations of motion and in the inputs."""
    leaves = {
        *eqs.parameters,
        *kinematics.parameters,
        *free_symbols([value for _, value in kinematics.given]),
    }
    return {*parameters_among(leaves)}


def _check_unknowns(eqs: Equations, kinematics: Kinematics, motion: object, loads: Sequence[Expr]) -> None:
    """Check that unknowns are in the equations, and do not influence the motion."""
    held = [z for z in eqs.states if z in free_symbols(eqs.derived_residuals)]
    functions = [leaf for leaf in eqs.inputs if not leaf.order and leaf not in dict(kinematics.given)] + held
    known = [*sorted(_parameters(eqs, kinematics), key=str), *functions]
    formulas = (
        [value for value in motion.values() if isinstance(value, Expr)] if isinstance(motion, Mapping) else []
    )
    in_constraints = eqs.states if kinematics.has_states else ()
    moving = {leaf.name for leaf in kinematics.leaves | free_symbols(formulas) | {*in_constraints}}
    for name in loads:
        if name not in known:
            raise ModelError(
                f"{_WHERE}, unknowns: {name} isn't in the equations of motion; expected symbols or functions of time "
                f"in the loads: {', '.join(map(str, known)) or 'there are none'}"
            )
        if name.name in moving:
            raise ModelError(
                f"{_WHERE}, unknowns: {name} occurs in the prescribed motion, the constraints or the kinematics; "
                "expected unknowns that only loads contain"
            )


def _without(parameters: Mapping[Expr, ArrayLike] | None, loads: Sequence[Expr]) -> Mapping[Expr, ArrayLike]:
    if not isinstance(parameters, Mapping | None):
        raise ArgumentError(
            f"{_WHERE}, parameters: {described(parameters)}; expected a dictionary of variables and their values"
        )
    return {name: value for name, value in (parameters or {}).items() if name not in loads}


def _check_left_out(**arguments: object) -> None:
    """Check that arguments which a simulated motion replaces are not given."""
    given = [name for name, value in arguments.items() if value is not None]
    if given:
        raise ArgumentError(
            f"{_WHERE}: {' and '.join(given)}, and a simulated motion, which has its own; leave out "
            f"{' and '.join(given)}"
        )
