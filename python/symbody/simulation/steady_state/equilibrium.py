"""Equilibria: positions in which a system stays at rest, and the forces that hold it there."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

from symbody.dynamics import Equations
from symbody.errors import ModelError, SimulationError, notify
from symbody.multibody import Variables
from symbody.multibody.joint.freedom import Freedom
from symbody.simulation.constraint.consistent_position import positions
from symbody.simulation.constraint.kinematics import kinematics_of
from symbody.simulation.constraint.opposite_axes import check_senses
from symbody.simulation.given.odd_values import warn_of_odd_values
from symbody.simulation.given.values import given_inputs, parameter_values, state_values
from symbody.simulation.given.watched_limit import tell_passed_limits
from symbody.simulation.motion.reading import Reading
from symbody.simulation.steady_state.force_balance import Balance
from symbody.symbolic import Expr, ExprLike, free_symbols
from symbody.symbolic import t as time
from symbody.symbolic.expression.html_table import html_table
from symbody.symbolic.given.arguments import expression as as_expression
from symbody.symbolic.given.arguments import with_known_names
from symbody.symbolic.given.wording import joined_by_and
from symbody.symbolic.numeric.deficiency import reporting

from .failed_balance import not_isolated, unbalanced
from .implicit_slopes import ImplicitSlopes
from .rest_fault import check_finite, check_kinematics
from .rest_position import RestPosition
from .steady_conditions import conditions_of
from .value_table import HEADER, value_rows

__all__ = ["Equilibrium", "equilibrium"]

Array = NDArray[np.float64]

_WHERE = "equilibrium"

_READING = Reading(_WHERE, "its attributes, such as equilibrium.coordinates, have the values by name")


@dataclass(frozen=True, eq=False)
class Equilibrium(Mapping[Expr, float]):
    """A system at rest: a mapping of its coordinates and of the states beside the mechanics; all speeds are zero.

    So it can be given where a state is, as in ``simulate(initial=found)`` and ``linearize(about=found)``.
    ``found[expression]`` is the value of any expression of the model, such as the component of a reaction.

    Attributes:
        coordinates: the values of all coordinates, in the units of the model.
        multipliers: the values of the multipliers, by their functions of time; empty without constraints.
        holding: the generalised forces that hold the fixed coordinates, by coordinate.
        residual: the largest generalised force that is left in the equations of motion.
        eigenvalues: the s of the small motions ``x exp(s t)``, in 1/s, shape (number of eigenvalues,), the fastest
            growing first. No coordinate is
            held: the holding forces are constant forces along the fixed coordinates. NaN at a singular position,
            where small motions are not those of a linear system.
        held_eigenvalues: those of the motions in which the fixed coordinates stay fixed; the same if none is fixed.
        states: the values of the states beside the mechanics, whose rates are zero.
        inputs: the expressions of the inputs that were given; ``linearize(about=found)`` reads them.
        parameters: the values of the parameters that were given.
        slopes: how it moves when parameters change; see `sensitivity`.

    Forces that the position does not determine, such as those of dependent constraints, are those of minimum norm,
    where those that hold coordinates take only what the others don't bear. A notice names them, unless they belong to
    constraints that are redundant everywhere.

    >>> from symbody import Body, Force, System, functions_of_time, ground, newton_euler, symbols, translate
    >>> x, (m, k, F) = functions_of_time("x"), symbols("m k F")
    >>> cart = Body(translate(x, 0, 0), m)
    >>> spring = Force(ground, F - k * x, 0, 0, at=cart.center_of_mass, on=cart)
    >>> found = equilibrium(newton_euler(System([cart], [spring], coordinates=[x])), {m: 1, k: 4, F: 2})
    >>> found.coordinates, found.is_stable
    ({x: 0.5}, True)
    """

    coordinates: dict[Expr, float]
    multipliers: dict[Expr, float]
    holding: dict[Expr, float]
    residual: float
    eigenvalues: NDArray[np.complex128]
    held_eigenvalues: NDArray[np.complex128]
    states: dict[Expr, float] = field(default_factory=dict)
    inputs: dict[Expr, Expr] = field(default_factory=dict)
    parameters: dict[Expr, float] = field(default_factory=dict)
    slopes: ImplicitSlopes | None = field(default=None, repr=False)

    @with_known_names
    def sensitivity(self, expression: Expr, by: Expr) -> float:
        """Return the derivative of an expression by a parameter, an input, or the value of a fixed coordinate.

        ``F_x dx/dp = -F_p`` for the conditions ``F(x, p) = 0`` of rest, with exact derivatives.

        Args:
            expression: an expression of coordinates, states, multipliers and parameters.
            by: the parameter, the input, or the fixed coordinate.

        Raises:
            ParameterError: it is none of these.
            SimulationError: the equilibrium has no derivative by it, or the expression contains something unknown.

        >>> from symbody import Body, Force, System, functions_of_time, ground, newton_euler, symbols, translate
        >>> x, (m, k, F) = functions_of_time("x"), symbols("m k F")
        >>> cart = Body(translate(x, 0, 0), m)
        >>> spring = Force(ground, F - k * x, 0, 0, at=cart.center_of_mass, on=cart)
        >>> found = equilibrium(newton_euler(System([cart], [spring], coordinates=[x])), {m: 1, k: 4, F: 2})
        >>> found.sensitivity(x, by=k), found.sensitivity(k * x**2 / 2, by=k)
        (-0.125, -0.125)
        """
        (written,) = self._written([as_expression(expression, _WHERE)], f"{_WHERE}.sensitivity")
        return self._solution.of(written, self.known, by)

    @cached_property
    def known(self) -> dict[Expr, float]:
        """The values of all coordinates, states, multipliers and parameters, and of the time."""
        balance = self._solution.balance
        constants = dict(zip(balance.conditions.parameters, map(float, balance.p), strict=True))
        return {
            **self.parameters,
            **constants,
            **self.multipliers,
            **self.coordinates,
            **self.states,
            time: balance.t,
        }

    @property
    def system(self) -> Variables:
        """The system that is at rest."""
        return self._solution.balance.equations.system

    @property
    def t(self) -> float:
        """The time, in s."""
        return self._solution.balance.t

    @property
    def _solution(self) -> ImplicitSlopes:
        assert self.slopes is not None, "equilibrium() gives it"
        return self.slopes

    def _written(self, expressions: Sequence[Expr], where: str) -> tuple[Expr, ...]:
        """Return expressions at rest by the names in `known`.

        Raises:
            SimulationError: a variable in them has no value.
        """
        balance = self._solution.balance
        found, eqs = balance.conditions.written(expressions), balance.equations
        strange = sorted(map(str, free_symbols(found) - self.known.keys()))
        if strange:
            raise SimulationError(
                f"{where}: no value of {joined_by_and(strange)}; expected an expression of "
                f"{joined_by_and([*map(str, (*eqs.coordinates, *eqs.states)), 'multipliers', 'parameters'], most=12)}"
            )
        return found

    def __getitem__(self, expression: Expr | Freedom) -> float:
        """Return the value of a coordinate, a state or a freedom of a joint, or of an expression, as of a reaction.

        Raises:
            ArgumentError: the argument is not an expression, or is a number.
            SimulationError: a variable in it has no value.
        """
        asked = _READING.one_expression(expression, [*self.coordinates])
        if asked in self:
            return {**self.coordinates, **self.states}[asked]
        return float(self._values([asked], f"{_WHERE}[...]")[0])

    @with_known_names
    def evaluate(self, expressions: Sequence[ExprLike]) -> Array:
        """Return the values of several expressions, such as the components of a reaction: shape (expressions,).

        Speeds and accelerations are zero.

        Raises:
            ArgumentError: the argument is not a list of expressions.
            SimulationError: a variable in them has no value.

        >>> from symbody import Link, Vector, assemble, equilibrium, ground, newton_euler, reaction, revolute
        >>> pin = revolute("A", ground, Link("bob", 2, center=(0, -1, 0)))
        >>> equations = newton_euler(assemble([pin]).system(gravity=Vector(ground, 0, -10, 0)))
        >>> equilibrium(equations, {}).evaluate(reaction(equations, pin).force.components)
        array([ 0., 20.,  0.])
        """
        return self._values(_READING.several_expressions(expressions), f"{_WHERE}.evaluate")

    def _values(self, expressions: Sequence[Expr], where: str) -> Array:
        known = self.known
        found = [
            each.evaluate({name: known[name] for name in each.free_symbols})
            for each in self._written(expressions, where)
        ]
        return np.array(found, dtype=np.float64) + 0.0

    def __contains__(self, name: object) -> bool:
        return name in self.coordinates or name in self.states

    def __iter__(self) -> Iterator[Expr]:
        return iter((*self.coordinates, *self.states))

    def __len__(self) -> int:
        return len(self.coordinates) + len(self.states)

    def _repr_html_(self) -> str:
        kinds = {
            "coordinate": self.coordinates,
            "state": self.states,
            "multiplier": self.multipliers,
            "holding force": self.holding,
        }
        rows = value_rows(kinds)
        rows += [["eigenvalue", f"s{k}", f"{s:.6g}"] for k, s in enumerate(self.eigenvalues, start=1)]
        if np.isnan(self.eigenvalues).any():
            title = "Equilibrium at a singular position"
        else:
            title = "Stable equilibrium" if self.is_stable else "Unstable equilibrium"
        return html_table(title, HEADER, rows)

    @property
    def is_stable(self) -> bool:
        """Whether no small motion of the free system grows: no eigenvalue has a positive real part.

        Raises:
            SimulationError: the position is singular, so that the eigenvalues are unknown.
        """
        return _decays(self.eigenvalues)

    @property
    def is_stable_held(self) -> bool:
        """Whether no small motion grows while the fixed coordinates stay fixed.

        Raises:
            SimulationError: the position is singular, so that the eigenvalues are unknown.
        """
        return _decays(self.held_eigenvalues)


def _decays(eigenvalues: NDArray[np.complex128]) -> bool:
    if np.isnan(eigenvalues).any():
        raise SimulationError(
            f"{_WHERE}: the position is singular, so that small motions about it are not known; expected a position "
            "at which the constraints are independent: try a position nearby, or simulate"
        )
    size = np.abs(eigenvalues).max(initial=0.0)
    return bool((eigenvalues.real <= 1e-8 * size).all())


@with_known_names
def equilibrium(
    eqs: Equations,
    parameters: Mapping[Expr, ArrayLike] | None,
    *,
    guess: Mapping[Expr, ArrayLike] | None = None,
    fixed: Mapping[Expr, ArrayLike] | None = None,
    t: float | None = None,
    inputs: Mapping[Expr, ExprLike] | None = None,
) -> Equilibrium:
    """Return a position near a guess in which the system stays at rest.

    ``-forcing - phi_q^T lambda = 0``, ``phi = 0`` and, for states z, ``z' = 0``, at zero speeds and accelerations, by
    damped Gauss-Newton steps with exact derivatives. The guess decides which of several equilibria is found; it may be
    unstable.

    If coordinates are fixed, the system stays at rest by itself only if the holding forces are zero or act on it as
    constant forces. The attribute `eigenvalues` is meant in this sense, `held_eigenvalues` with coordinates held.

    Args:
        eqs: the equations of motion.
        parameters: the values of all symbols.
        guess: coordinates and states near the equilibrium. By default, they are zero, and floating frames are not
            rotated.
        fixed: the values of coordinates that are held; the result has the forces that hold them. And those of states
            that rest leaves open, such as the slips of tyres.
        t: the time in loads and constraints, in s: an instant at which forces are in balance. By default it is 0, and
            a notice tells if the system does not stay at rest later.
        inputs: expressions of time and coordinates for the input functions of time.

    Raises:
        SimulationError: no equilibrium was found, or it is not isolated, or the equations are not finite there.
        ModelError: kinematics move a coordinate at zero speeds.
        ConstraintError: no position satisfies the constraints.
        ParameterError: a value is missing, has an unknown key, or is not finite.

    >>> from symbody import Body, System, Vector, functions_of_time, ground, newton_euler, rotate, symbols, translate
    >>> theta, (m, l, g) = functions_of_time("theta"), symbols("m l g")
    >>> bob = Body(rotate("Y", theta) * translate(0, 0, l), m)
    >>> eqs = newton_euler(System([bob], coordinates=[theta], gravity=Vector(ground, 0, 0, g)))
    >>> hanging = equilibrium(eqs, {m: 1, l: 2, g: 8}, guess={theta: 0.5})
    >>> hanging.coordinates, hanging.is_stable, hanging.eigenvalues.round(9)
    ({theta: 0.0}, True, array([0.-2.j, 0.+2.j]))
    """
    with reporting(_WHERE):
        given = given_inputs(eqs, inputs, where=_WHERE, parameters=parameters, example="0")
        place = _place(eqs, parameters, guess, fixed, t or 0.0, given)
        numbers = {name: float(np.asarray(value)) for name, value in (parameters or {}).items()}
        found = _sharing(replace(_result(place), inputs=given, parameters=numbers), place)
        notices = list(place.notices(at_instant=t is not None))
    for notice in notices:
        notify(f"{_WHERE}: {notice}")
    tell_passed_limits(eqs.system, found.known, given, _WHERE)
    return found


def _place(
    eqs: Equations,
    parameters: Mapping[Expr, ArrayLike] | None,
    guess: Mapping[Expr, ArrayLike] | None,
    fixed: Mapping[Expr, ArrayLike] | None,
    t: float,
    given: Mapping[Expr, Expr],
) -> RestPosition:
    """Return the position at which the system stays at rest.

    Args:
        eqs: the equations of motion.
        parameters: the values of all symbols.
        guess: coordinates near the equilibrium.
        fixed: the values of coordinates that are held.
        t: the time, in s.
        given: the expressions that replace input functions of time.
    """
    kinematics = kinematics_of(eqs, given)
    conditions = conditions_of(eqs, kinematics.given)
    check_kinematics(conditions)
    p = parameter_values(conditions.parameters, parameters, where=_WHERE, beside=eqs.system.state_names)
    has_states = bool(eqs.states)
    fixed_values = state_values(
        eqs.system, fixed, where=_WHERE, argument="fixed", has_speeds=False, has_states=has_states
    )
    held = {name: value for name, value in fixed_values.items() if name not in eqs.states}
    near = state_values(
        eqs.system, guess, where=_WHERE, argument="guess", has_speeds=False, has_states=has_states
    )
    warn_of_odd_values(eqs, parameters or {}, list(given.values()), _WHERE)
    if held and eqs.system.momenta:
        raise ModelError(
            f"{_WHERE}, fixed: the speeds of the equations are momenta, along which no forces act; expected equations "
            "in speeds, such as newton_euler(system), to hold coordinates"
        )
    problem = Balance(conditions, t, p, tuple(fixed_values), tuple(held))
    constants = dict(zip(conditions.parameters, p, strict=True))
    of_constraints = np.array([constants[name] for name in kinematics.parameters])
    at = {name: value for name, value in near.items() if name not in eqs.states}
    q = positions(kinematics, of_constraints, t, held, at, where=_WHERE)
    q = np.append(q, [fixed_values.get(state, near.get(state, 0.0)) for state in eqs.states])
    solution = _solved(problem, q)
    check_finite(problem, solution)
    check_senses(kinematics, of_constraints, t, solution[0][: len(eqs.coordinates)], _WHERE)
    _check_single(problem, solution)
    return RestPosition(problem, kinematics, of_constraints, *solution)


def _result(place: RestPosition) -> Equilibrium:
    """Return the result by the names of the model."""
    problem, q, forces = place.problem, place.q, place.least_forces
    m, n = len(problem.equations.constraints), len(problem.equations.speeds)
    width = len(problem.equations.coordinates)
    F, _, _ = problem.values(q, forces)
    return Equilibrium(
        coordinates=_named(problem.equations.coordinates, q[:width]),
        states=_named(problem.equations.states, q[width:]),
        multipliers=_named(problem.equations.multipliers, forces[:m]),
        holding=_named(problem.order, forces[m:]),
        residual=float(np.abs(F[:n]).max()),
        eigenvalues=place.eigenvalues(is_held=False),
        held_eigenvalues=place.eigenvalues(is_held=True),
        slopes=ImplicitSlopes(problem, q, forces, f"{_WHERE}.sensitivity"),
    )


def _sharing(found: Equilibrium, place: RestPosition) -> Equilibrium:
    """Return an equilibrium with the multipliers and holding forces of which joints bear the least."""
    if not place.undetermined.idle:
        return found
    forces = place.undetermined.shared(found.evaluate)
    equations = place.problem.equations
    m = len(equations.constraints)
    assert found.slopes is not None
    return replace(
        found,
        multipliers=_named(equations.multipliers, forces[:m]),
        holding=_named(place.problem.order, forces[m:]),
        slopes=replace(found.slopes, forces=forces),
    )


def _named(names: Sequence[Expr], values: Array) -> dict[Expr, float]:
    return {name: float(value) + 0.0 for name, value in zip(names, values, strict=True)}


def _solved(problem: Balance, start: Array) -> tuple[Array, Array]:
    """Return an equilibrium, found from the start or from points around it.

    Raises:
        SimulationError: none was found.
    """
    found = problem.searched(start)
    if found.solution is None:
        raise SimulationError(unbalanced(problem, *found.nearest, _WHERE))
    return found.solution


def _check_single(problem: Balance, solution: tuple[Array, Array]) -> None:
    """Check that an equilibrium is isolated.

    Raises:
        SimulationError: there is another one nearby.
    """
    direction = problem.other_nearby(*solution)
    if direction is not None:
        raise SimulationError(not_isolated(problem, solution[0], direction, _WHERE))
