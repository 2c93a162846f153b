"""The variables in which equations of motion are written, and the conditions that they keep."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from copy import copy
from itertools import count
from types import MappingProxyType
from typing import Annotated, Any, Self, TypeAlias

from symbody.deferred import cached_property
from symbody.errors import ModelError
from symbody.geometry.component.triple import Rate, expression
from symbody.geometry.motion.floating import by_speeds, known_rates, rate_by
from symbody.symbolic import (
    Expr,
    Matrix,
    free_symbols,
    functions_of_time,
    jacobian,
    number,
    substitute,
    time_derivative,
    time_derivatives,
)
from symbody.symbolic.expression.container import Container, contains
from symbody.symbolic.given.arguments import brief, counted

from .constraint import Condition, Constraint, as_constraint
from .constraint_fault import Unknowns, is_on_velocity
from .shared_multiplier import shared_multipliers
from .well_posed import check_constraints, check_inputs, check_multipliers, check_small, check_unknowns

__all__ = ["Conditions", "Coordinates", "Variables", "check_substitution"]

Coordinates: TypeAlias = Annotated[
    Sequence[Expr], "a list of functions of time, such as functions_of_time('x y')"
]
Conditions: TypeAlias = Annotated[
    Sequence[Condition],
    "a list of expressions that are zero, such as [x**2 + y**2 - l**2]",
]

Borne: TypeAlias = Callable[["Variables"], Sequence[Expr]]


def _multipliers_of(variables: Variables) -> Sequence[Expr]:
    return variables.multipliers


class Variables:
    """Coordinates, speeds, kinematics, constraints, multipliers and inputs: what equations of motion are written in.

    A `System` has them, besides bodies and loads. Equations that were derived elsewhere have nothing but them.

    Args:
        coordinates: the coordinates q.
        coordinate_rates: the coordinates whose rates are not speeds, and these rates by the speeds.
        speeds: the speeds that are no rates of coordinates (quasi-velocities).
        constraints: conditions on positions or on velocities.
        multipliers: one for each; ``lambda1``, ``lambda2``, ... by default.
        inputs: functions of time that are given from outside.
        states: functions of time beside the mechanics, and their rates.
        others: what the equations hold besides.
        name: what the system is called.
    """

    joints: tuple[Any, ...] = ()
    """The placed joints of a mechanism: one without coordinates is a structure, and has reactions alone."""
    where = "equations_of"
    """The function that the user called, for messages."""
    contents = "M, f or a constraint"
    """What the equations are made of, for messages."""

    def __init__(
        self,
        coordinates: Sequence[Expr],
        coordinate_rates: Mapping[Expr, Expr],
        *,
        speeds: Sequence[Expr] = (),
        constraints: Sequence[Condition] = (),
        multipliers: Sequence[Expr] = (),
        inputs: Sequence[Expr] = (),
        states: Mapping[Expr, Expr] = MappingProxyType({}),
        others: Sequence[Expr] = (),
        name: str = "",
    ) -> None:
        self.coordinates = tuple(coordinates)
        self.coordinate_rates = dict(coordinate_rates)
        """The coordinates whose rates are not speeds, as those of floating frames, and these rates by the speeds."""
        self.quasi_velocities = tuple(speeds)
        self.eliminated: dict[Expr, Expr] = {}
        """The speeds that constraints made dependent, each by the independent ones; none unless `eliminating` did."""
        self.left_out: dict[Expr, Constraint] = {}
        """The constraints that follow from the others, by their multipliers; see `leaving_out`."""
        self.borne: Borne = _multipliers_of
        """What redundant constraints share: the function of the system that returns it; see there."""
        self.whole: Variables = self
        """The same with all constraints, in its own speeds; mostly itself."""
        self.momenta: dict[Expr, Expr] = {}
        """The momenta that took the place of all speeds, each by these; none unless `eliminating` brought them."""
        self.conditions = tuple(as_constraint(constraint) for constraint in constraints)
        """The constraints as values, with their names and what they connect."""
        self.others = tuple(others)
        self._given_rates = dict(states)
        self.states: tuple[Expr, ...] = tuple(self._given_rates)
        """The functions of time beside the mechanics whose rates are given."""
        self.name = name
        self.multipliers = tuple(multipliers) or self._default_multipliers()
        self.inputs = tuple(expression(each) for each in inputs)

    def check(self) -> None:
        """Check that variables and conditions can be those of equations.

        Raises:
            ModelError: a coordinate, speed or input is not a function of time, or is given twice.
            ConstraintError: a constraint is no condition on positions or velocities, or a multiplier is something else.
        """
        where, unknowns = self.where, (*self.coordinates, *self.quasi_velocities, *self.multipliers)
        self._check_freedom()
        check_unknowns(where, self.coordinates, self.quasi_velocities)
        check_constraints(where, self.conditions, self.multipliers, self._unknowns)
        taken = self._names() if self.multipliers else frozenset()
        check_multipliers(where, self.contents, self.multipliers, self.states, taken)
        check_inputs(where, self.inputs, unknowns)
        check_small(where, self._first_order)

    def _check_freedom(self) -> None:
        if not self.driving and self.coordinates:
            raise ModelError(
                f"{self.where}: no speeds, but the rates of all coordinates are given; list the speeds that they hold: "
                "speeds=[...]"
            )
        if not self.driving and not self.joints:
            raise ModelError(
                f"{self.where}: no coordinates; give the functions of time that describe the motion, in order"
            )

    @cached_property
    def constraints(self) -> tuple[Expr, ...]:
        """The constraints as expressions that are zero: on positions, and on velocities as they were given."""
        return tuple(each.condition for each in self.conditions)

    @cached_property
    def holonomic(self) -> tuple[int, ...]:
        """The places of the constraints on positions among all."""
        unknowns = self._unknowns
        return tuple(k for k, each in enumerate(self.constraints) if not is_on_velocity(each, unknowns))

    @property
    def is_holonomic(self) -> bool:
        """Whether all constraints are conditions on positions."""
        return len(self.holonomic) == len(self.constraints)

    @cached_property
    def position_constraints(self) -> tuple[Expr, ...]:
        """The constraints on positions, phi."""
        return tuple(self.constraints[k] for k in self.holonomic)

    @property
    def eliminated_constraints(self) -> tuple[Expr, ...]:
        """The constraints on positions that were eliminated with speeds: motions that begin on them keep them."""
        return self.whole.position_constraints if self.eliminated and not self.constraints else ()

    def velocity_level(self, constraints: Sequence[Expr]) -> tuple[Expr, ...]:
        """Return ``A u + b``, one per constraint: the rate of a condition on positions, or the condition itself.

        Args:
            constraints: those of the system, in these or other forms.
        """
        if self.is_holonomic:
            return self.rate(constraints)
        rates = iter(self.rate([constraints[k] for k in self.holonomic]))
        others = self.by_speeds(constraints)
        return tuple(next(rates) if k in self.holonomic else other for k, other in enumerate(others))

    @property
    def _unknowns(self) -> Unknowns:
        speeds = (*self.quasi_velocities, *(u for u in self.eliminated if u.order == 0))
        rates = tuple(self.coordinate_rates.values())
        return Unknowns(self.coordinates, speeds, self.speeds, self.by_speeds, rates)

    @cached_property
    def driving(self) -> tuple[Expr, ...]:
        """The quasi-velocities, then the coordinates whose rates are speeds: the freedoms of the motion."""
        return self.quasi_velocities + tuple(q for q in self.coordinates if q not in self.coordinate_rates)

    @cached_property
    def speeds(self) -> tuple[Expr, ...]:
        """The speeds, one per equation of motion: the quasi-velocities, then rates of coordinates."""
        n = len(self.quasi_velocities)
        return self.quasi_velocities + tuple(time_derivative(q) for q in self.driving[n:])

    @cached_property
    def accelerations(self) -> tuple[Expr, ...]:
        """The rates of the speeds."""
        return tuple(time_derivative(u) for u in self.speeds)

    @cached_property
    def state_names(self) -> tuple[Expr, ...]:
        """The names by which values may be given: coordinates, speeds, rates of coordinates, and states."""
        rates = (time_derivative(q) for q in self.coordinates)
        known = (*self.coordinates, *self.speeds, *rates, *self.eliminated, *self.states)
        return tuple(dict.fromkeys(known))

    @property
    def has_quasi_velocities(self) -> bool:
        """Whether some speed is not the rate of a coordinate, or some rate not a speed."""
        return self.driving != self.coordinates

    @property
    def kinematics(self) -> dict[Expr, Expr]:
        """The rates of all coordinates by the speeds."""
        rates = (time_derivative(q) for q in self.coordinates)
        return {rate: self.known_rates.get(rate, rate) for rate in rates}

    @cached_property
    def known_rates(self) -> dict[Expr, Expr]:
        """The rates of coordinates that are not speeds, by the speeds, and those of states."""
        return known_rates(self._first_order)

    @cached_property
    def state_rates(self) -> dict[Expr, Expr]:
        """The rates of the states, in which rates of coordinates are written by the speeds: the rates are the keys."""
        rates = self._written(self.coordinate_rates, [*self._given_rates.values()])
        return {time_derivative(z): rate for z, rate in zip(self.states, rates, strict=True)}

    @cached_property
    def _first_order(self) -> dict[Expr, Expr]:
        """The coordinates and states whose rates are given, and these rates."""
        return {**self.coordinate_rates, **dict(zip(self.states, self.state_rates.values(), strict=True))}

    @property
    def rate(self) -> Rate:
        """The time derivative, with these rates put in."""
        if self.eliminated:
            return lambda values: self.by_speeds(time_derivatives(values))
        return rate_by(self._first_order)

    def by_speeds(self, expressions: Sequence[Expr]) -> tuple[Expr, ...]:
        """Return expressions with the rates of coordinates by the speeds and their rates, and those of states."""
        return self._written(self._first_order, expressions)

    def _written(self, rates: Mapping[Expr, Expr], expressions: Sequence[Expr]) -> tuple[Expr, ...]:
        written = substitute(tuple(expressions), self.eliminated) if self.eliminated else expressions
        return by_speeds(rates, self._shared(written) if self.left_out else written)

    def _shared(self, expressions: Sequence[Expr]) -> tuple[Expr, ...]:
        """Return expressions in which the multipliers of all constraints are their shares of those that are kept."""
        names = {each.name: k for k, each in enumerate(self.whole.multipliers)}
        found = {leaf: names[leaf.name] for leaf in free_symbols(expressions) if leaf.name in names}
        shares = {leaf: time_derivative(self._shares[k], leaf.order) for leaf, k in found.items()}
        return substitute(tuple(expressions), shares)

    @cached_property
    def _shares(self) -> tuple[Expr, ...]:
        whole = self.whole
        kept = [k for k, each in enumerate(whole.multipliers) if each not in self.left_out]
        borne = self.borne(whole)
        return shared_multipliers(whole.velocity_gradients, kept, self.multipliers, whole.multipliers, borne)

    @cached_property
    def velocity_gradients(self) -> Matrix:
        """A of ``A u + b``, the constraints on the level of velocities: one row each, a column per speed."""
        return jacobian(self.velocity_level(self.constraints), self.speeds)

    def without_left_out(self, expressions: Sequence[Expr]) -> tuple[Expr, ...]:
        """Return terms of the equations of all constraints without the forces of those that were left out."""
        kept = [each for each in self.whole.multipliers if each not in self.left_out]
        own = dict(zip(kept, self.multipliers, strict=True))
        return substitute(tuple(expressions), own | dict.fromkeys(self.left_out, number(0)))

    def leaving_out(self, places: Collection[int], borne: Borne) -> Self:
        """Return the same without some constraints, which follow from the others.

        The multipliers of those that are kept get other names, since they bear what all would share: those of all
        constraints are of minimum norm, wherever an expression contains them.

        Args:
            places: their places among the constraints.
            borne: the function of the system that returns what this norm is of, linear in the multipliers.
        """
        reduced = self._copied()
        reduced.borne = borne
        kept = [k for k in range(len(self.conditions)) if k not in places]
        reduced.conditions = tuple(self.conditions[k] for k in kept)
        reduced.multipliers = tuple(self._of_kept(self.multipliers[k].name) for k in kept)
        reduced.left_out = self.left_out | {self.multipliers[k]: self.conditions[k] for k in sorted(places)}
        return reduced

    def _of_kept(self, name: str) -> Expr:
        name = f"{name}_kept"
        found: Expr = self._of_kept(name) if name in self._names() else functions_of_time(name)
        return found

    def eliminating(self, dependent: Mapping[Expr, Expr], momenta: Mapping[Expr, Expr] | None = None) -> Self:
        """Return the same in its independent speeds, without constraints; or in momenta, with all constraints.

        The coordinates stay; the rates of some are no longer speeds. Frames keep the dependent speeds: `by_speeds`
        writes expressions without them.

        Args:
            dependent: the other speeds by the independent ones, coordinates and time, as the constraints demand; all
                speeds by the momenta, if there are such.
            momenta: the momenta that take the place of all speeds, each by these.
        """
        reduced = self._copied()
        rates = zip(
            self.coordinate_rates, substitute([*self.coordinate_rates.values()], dependent), strict=True
        )
        linked = {
            q: dependent[time_derivative(q)] for q in self.coordinates if time_derivative(q) in dependent
        }
        reduced.coordinate_rates = {**dict(rates), **linked}
        if momenta:
            reduced.quasi_velocities, reduced.momenta = tuple(momenta), dict(momenta)
        else:
            reduced.quasi_velocities = tuple(u for u in self.quasi_velocities if u not in dependent)
            reduced.conditions, reduced.multipliers = (), ()
        reduced.eliminated, reduced.whole = dict(dependent), self
        if momenta:
            reduced.conditions = tuple(
                each if k in self.holonomic else each.written(*reduced.by_speeds([each.condition]))
                for k, each in enumerate(self.conditions)
            )
        return reduced

    def with_states(self, rates: Mapping[Expr, Expr]) -> Self:
        """Return the same with further states, on which nothing depends.

        Args:
            rates: the rate of each.
        """
        made = self._copied()
        vars(made)["_given_rates"] = {**self._given_rates, **rates}
        made.states = (*self.states, *rates)
        made.whole = made if self.whole is self else self.whole.with_states(rates)
        return made

    def _copied(self) -> Self:
        """Return a copy without what was found from its attributes."""
        made = copy(self)
        members = (member for kind in type(self).__mro__ for member in vars(kind).items())
        for name in (name for name, value in members if isinstance(value, cached_property)):
            vars(made).pop(name, None)
        return made

    def _default_multipliers(self) -> tuple[Expr, ...]:
        """Return the constraints' own multipliers, or ``lambda1``, ..., without names that the model uses already."""
        given = [each.multiplier for each in self.conditions]
        if None not in given:
            return tuple(each for each in given if each is not None)
        taken = self._names() | {each.name for each in given if each is not None}
        free = (functions_of_time(name) for name in (f"lambda{k}" for k in count(1)) if name not in taken)
        return tuple(next(free) if each is None else each for each in given)

    @cached_property
    def leaves(self) -> frozenset[Expr]:
        """All symbols and functions of time in the model, also those that its equations don't need."""
        rates = (rate.free_symbols for rate in self._given_rates.values())
        return self._leaves_without_rates.union(*rates)

    @cached_property
    def _leaves_without_rates(self) -> frozenset[Expr]:
        """The same without the rates of states, which may contain multipliers."""
        return frozenset({*self.coordinates, *self.quasi_velocities, *self.states}).union(
            *(value.free_symbols for value in self._values())
        )

    def _names(self) -> frozenset[str]:
        return frozenset(leaf.name for leaf in self._leaves_without_rates if leaf.kind != "application")

    def _values(self) -> Iterator[Expr]:
        yield from (*self.constraints, *self.coordinate_rates.values(), *self.others)

    def __repr__(self) -> str:
        parts = [counted(len(self.coordinates), "coordinate")]
        if self.quasi_velocities:
            parts.append(counted(len(self.quasi_velocities), "quasi-velocity"))
        if self.constraints:
            parts.append(counted(len(self.constraints), "constraint"))
        return f"Variables({', '.join([self.name, *parts] if self.name else parts)})"


def check_substitution(variables: Variables, mapping: Mapping[Any, Any]) -> None:
    """Raise an error for a substitution that would leave the equations without their unknowns."""
    unknowns = (
        *variables.coordinates,
        *variables.quasi_velocities,
        *variables.states,
        *variables.multipliers,
    )
    unknown = {each.name for each in unknowns}
    for key in mapping:
        if isinstance(key, Expr) and key.kind == "time_function" and key.name in unknown:
            raise ModelError(
                f"subs: {key} is an unknown of {brief(variables)}; expected parameters and inputs. Substitute in "
                "expressions of the system, such as equations.residuals"
            )


def _parts(variables: Variables) -> tuple[Any, ...]:
    whole = variables.whole
    return (
        tuple(whole.coordinate_rates.values()),
        whole.conditions,
        variables.inputs,
        variables.others,
        tuple(variables.eliminated.values()),
        tuple(variables.momenta.values()),
        tuple(whole.state_rates.values()),
    )


def _rebuilt(variables: Variables, parts: Sequence[Any]) -> Variables:
    rates, constraints, inputs, others, speeds, momenta, of_states = parts
    whole = variables.whole
    made = Variables(
        variables.coordinates,
        dict(zip(whole.coordinate_rates, rates, strict=True)),
        speeds=whole.quasi_velocities,
        constraints=constraints,
        multipliers=whole.multipliers,
        inputs=[each for each in inputs if each.kind == "time_function"],
        states=dict(zip(variables.states, of_states, strict=True)),
        others=others,
        name=variables.name,
    )
    made.check()
    if variables.left_out:
        made = made.leaving_out(
            [made.multipliers.index(each) for each in variables.left_out], variables.borne
        )
    if not speeds:
        return made
    pairs = (
        dict(zip(names, values, strict=True))
        for names, values in ((variables.eliminated, speeds), (variables.momenta, momenta))
    )
    return made.eliminating(*pairs)


contains(
    Variables,
    Container(
        _parts, _rebuilt, advice="the residuals of the equations of motion have one", subs=check_substitution
    ),
)
