"""Systems: bodies and loads, and the coordinates in which they move."""

from __future__ import annotations

import warnings
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from functools import cached_property
from itertools import count
from typing import Annotated, Any, TypeAlias, TypeVar, final

from symbody.errors import ConstraintError, ModelError, ModelNotice
from symbody.geometry import Frame, Vector
from symbody.geometry.component.triple import Rate, expression
from symbody.geometry.given.argument import checked
from symbody.geometry.motion.floating import by_speeds, known_rates, rate_by
from symbody.symbolic import Expr, functions_of_time, time_derivative
from symbody.symbolic.expression.container import Container, contains
from symbody.symbolic.expression.html_table import html_table
from symbody.symbolic.given.arguments import brief, counted

from .body import Body
from .constraint import Condition, as_constraint
from .constraint_fault import Unknowns, fault_of, is_on_velocity
from .coordinate import check_function_of_time
from .frames import all_frames
from .load import COLUMNS, Action, Load
from .oversight import notices
from .physical_inertia import report_impossible_differences
from .picture import picture
from .state import Unknown, check_holders, check_states, given_rates

Thing = TypeVar("Thing", Body, Load)


Bodies: TypeAlias = Annotated[Collection[Body], "a list of bodies, such as [Body(frame, mass)]"]
Loads: TypeAlias = Annotated[
    Collection[Load], "a list of forces and torques, such as [Torque(frame, x, y, z, on=body)]"
]
Coordinates: TypeAlias = Annotated[
    Sequence[Expr], "a list of functions of time, such as functions_of_time('x y')"
]
Conditions: TypeAlias = Annotated[
    Sequence[Condition],
    "a list of expressions that are zero, such as [x**2 + y**2 - l**2], or of Constraints",
]

Rates: TypeAlias = Annotated[
    Mapping[Expr, object],
    "a dictionary of functions of time and their rates, such as {z: (x - z)/T}",
]


@final
class System:
    """A multibody system: bodies and loads, and the coordinates in which they move.

    Sets are put in an order that doesn't depend on the run.

    Args:
        bodies: the bodies.
        loads: the forces and torques on bodies, except weight.
        coordinates: the functions of time in which the configuration is written, in the order of the equations; those
            of floating frames come first unless they are listed.
        constraints: expressions that are zero, or `Constraint` values: of coordinates and time, or linear in speeds
            and rates of coordinates, as for rolling.
        gravity: the acceleration of weight.
        speeds: the functions of time that are velocities in moving frames (quasi-velocities); those of floating frames
            come first unless they are listed.
        multipliers: one function of time per constraint; ``lambda1``, ``lambda2``, ... by default.
        inputs: the functions of time in frames and constraints that are given from outside. Unlisted ones are inputs
            too, but a notice names them: they may be forgotten coordinates. Functions of time in loads need no list.
        states: functions of time z beside the mechanics, which loads may hold, each with its rate z': an expression of
            time, coordinates, speeds, accelerations, multipliers, states, inputs and parameters.
        name: what the system is called.

    >>> from symbody import Body, System, Vector, functions_of_time, ground, rotate, symbols, translate
    >>> theta, (m, l, g) = functions_of_time("theta"), symbols("m l g")
    >>> bob = Body(rotate("Z", theta) * translate(0, -l, 0), m)
    >>> pendulum = System([bob], coordinates=[theta], gravity=Vector(ground, 0, -g, 0), name="pendulum")
    >>> pendulum
    System(pendulum, 1 body, 0 loads, 1 coordinate)
    >>> pendulum.speeds
    (theta',)
    """

    @checked(ModelError)
    def __init__(
        self,
        bodies: Bodies,
        loads: Loads = (),
        coordinates: Coordinates = (),
        constraints: Conditions = (),
        gravity: Vector | None = None,
        *,
        speeds: Coordinates = (),
        multipliers: Coordinates = (),
        inputs: Coordinates = (),
        states: Rates | None = None,
        name: str = "",
    ) -> None:
        self.bodies: tuple[Body, ...] = _ordered(bodies)
        self.loads: tuple[Load, ...] = _ordered(loads)
        self.gravity = gravity
        self._frames = all_frames(self.bodies, self.loads, gravity)
        motions = [frame.motion for frame in self._frames if frame.motion is not None]
        self.coordinate_rates = {q: rate for motion in motions for q, rate in motion.coordinate_rates.items()}
        """The coordinates whose rates are not speeds, as those of floating frames, and these rates by the speeds."""
        self.coordinates = _completed(coordinates, self.coordinate_rates)
        self.quasi_velocities = _completed(speeds, [u for motion in motions for u in motion.speeds])
        self.conditions = tuple(as_constraint(constraint) for constraint in constraints)
        """The constraints as values, with their names and what they connect."""
        self.name = name
        self._given_rates = given_rates(states)
        self.states: tuple[Expr, ...] = tuple(self._given_rates)
        """The functions of time beside the mechanics whose rates are given."""
        self.multipliers = tuple(multipliers) or self._default_multipliers()
        self.inputs = tuple(expression(each) for each in inputs)
        self._check()

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
        return Unknowns(self.coordinates, self.quasi_velocities, self.speeds, self.by_speeds)

    @cached_property
    def root(self) -> Frame:
        """The frame to which all bodies are attached: ground, or a moving master frame."""
        return self.bodies[0].frame.ancestor

    @cached_property
    def actions(self) -> tuple[Action, ...]:
        """The actions of the loads on the bodies of the system; actions on other bodies are left out."""
        members = {*self.bodies}
        return tuple(action for load in self.loads for action in load.actions if action.body in members)

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
        return tuple(dict.fromkeys((*self.coordinates, *self.speeds, *rates, *self.states)))

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
        rates = by_speeds(self.coordinate_rates, [*self._given_rates.values()])
        return {time_derivative(z): rate for z, rate in zip(self.states, rates, strict=True)}

    @cached_property
    def _first_order(self) -> dict[Expr, Expr]:
        """The coordinates and states whose rates are given, and these rates."""
        return {**self.coordinate_rates, **dict(zip(self.states, self.state_rates.values(), strict=True))}

    @cached_property
    def rate(self) -> Rate:
        """The time derivative, with these rates put in."""
        return rate_by(self._first_order)

    def by_speeds(self, expressions: Sequence[Expr]) -> tuple[Expr, ...]:
        """Return expressions with the rates of coordinates by the speeds and their rates, and those of states."""
        return by_speeds(self._first_order, expressions)

    def _check(self) -> None:
        if not self.bodies:
            raise ModelError("System: no bodies; give at least one")
        _check_single(self.bodies, "the body")
        _check_single(self.loads, "the load")
        self._check_gravity()
        self._check_coordinates()
        self._check_constraints()
        self._check_multipliers()
        self._check_inputs()
        self._check_states()
        report_impossible_differences(self.bodies)
        known = (*self.coordinates, *self.quasi_velocities, *self.inputs, *self.states)
        for notice in notices(self.bodies, self.loads, self.constraints, known):
            warnings.warn(f"System: {notice}", ModelNotice, stacklevel=4)

    def _check_coordinates(self) -> None:
        if not self.driving:
            raise ModelError(
                "System: no coordinates; give the functions of time that describe the motion, in order"
            )
        for coordinate in self.coordinates:
            check_function_of_time(coordinate, "System: the coordinate")
        for speed in self.quasi_velocities:
            check_function_of_time(speed, "System: the speed")
        _check_single(self.coordinates, "the coordinate")
        _check_single(self.quasi_velocities, "the speed")
        for speed in self.quasi_velocities:
            if speed in self.coordinates:
                raise ModelError(
                    f"System: {speed} is both a coordinate and a speed; the rates of coordinates are speeds anyway: "
                    "leave it out of one of them"
                )

    def _check_inputs(self) -> None:
        for given in self.inputs:
            check_function_of_time(given, "System: the input")
            if given in (*self.coordinates, *self.quasi_velocities, *self.multipliers):
                raise ModelError(
                    f"System: {given} is an input and unknown; leave it out of inputs, or of coordinates, speeds and "
                    "multipliers"
                )

    def _check_states(self) -> None:
        unknown = Unknown(self.coordinates, self.quasi_velocities, self.multipliers, self.inputs)
        check_states(self._given_rates, unknown)
        check_holders(self._given_rates, self._frames, self.gravity, self.loads, self.constraints, unknown)

    def _check_gravity(self) -> None:
        if self.gravity is not None and self.gravity.frame.ancestor != self.root:
            raise ModelError(
                f"System: the gravity is given in {brief(self.gravity.frame)}, which can't be seen from {self.root}, "
                f"on which the bodies hang; give its components in {self.root}"
            )

    def _check_constraints(self) -> None:
        m = len(self.constraints)
        if len(self.multipliers) != m:
            raise ConstraintError(
                f"System: {counted(len(self.multipliers), 'multiplier')} for {counted(m, 'constraint')}; "
                "give one for each"
            )
        unknowns = self._unknowns
        for number, constraint in enumerate(self.conditions, start=1):
            fault = fault_of(constraint.condition, unknowns)
            if fault:
                raise ConstraintError(f"System: constraint {number}, {constraint}, {fault}")

    def _check_multipliers(self) -> None:
        for multiplier in self.multipliers:
            check_function_of_time(multiplier, "System: the multiplier")
        _check_single(self.multipliers, "the multiplier")
        taken = self._names() if self.multipliers else frozenset()
        for multiplier in self.multipliers:
            if multiplier.name in taken:
                raise ConstraintError(
                    f"System: the multiplier {multiplier} is a coordinate, or in a frame, a load or a constraint; "
                    "expected a function of time of its own, such as functions_of_time('lambda1')"
                )

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
        """The same without the rates of states, which may hold multipliers."""
        return frozenset({*self.coordinates, *self.quasi_velocities, *self.states}).union(
            *(value.free_symbols for value in self._values())
        )

    def _names(self) -> frozenset[str]:
        return frozenset(leaf.name for leaf in self._leaves_without_rates if leaf.kind != "application")

    def _values(self) -> Iterator[Expr]:
        yield from self.constraints
        for body in self.bodies:
            yield from (body.mass, *body.moments, *body.products)
        for action in (action for load in self.loads for action in load.actions):
            yield from action.vector.components
            if action.point is not None:
                yield from action.point.coordinates
        if self.gravity is not None:
            yield from self.gravity.components
        for frame in self._frames:
            if frame.motion is not None:
                yield from frame.motion.variables
            if frame.carrier is not None:
                yield from (*frame.carrier.angular, *frame.carrier.linear)

    def _repr_html_(self) -> str:
        """Return tables of the bodies, the loads, the unknowns and the constraints, and the picture."""
        labels = {body: _label(body, k) for k, body in enumerate(self.bodies, start=1)}
        bodies = [
            [label, body.frame, body.mass, ", ".join(map(brief, body.moments))]
            for body, label in labels.items()
        ]
        tables = [html_table(str(self), ["body", "frame", "mass", "moments of inertia"], bodies)]
        loads = [
            [_label(load, k), *action.row[:-1], labels.get(action.body, action.body)]
            for k, load in enumerate(self.loads, start=1)
            for action in load.actions
        ]
        if self.gravity is not None:
            components = ", ".join(map(brief, self.gravity.components))
            loads.append(["gravity", "acceleration", components, self.gravity.frame, "", "all bodies"])
        if loads:
            tables.append(html_table("", ["load", *COLUMNS], loads))
        names = {
            "coordinates": self.coordinates,
            "speeds": self.quasi_velocities,
            "states": self.states,
            "inputs": self.inputs,
        }
        unknowns = [(kind, ", ".join(map(str, each))) for kind, each in names.items() if each]
        tables.append(html_table("", ["unknowns", "names"], unknowns))
        if self.states:
            tables.append(
                html_table("", ["rate", "of a state"], [[*pair] for pair in self.state_rates.items()])
            )
        if self.constraints:
            pairs = zip(self.constraints, self.multipliers, strict=True)
            tables.append(
                html_table("", ["constraint", "multiplier"], [[f"{c} = 0", each] for c, each in pairs])
            )
        return "".join([*tables, picture(self)])

    def __repr__(self) -> str:
        parts = [
            counted(len(self.bodies), "body"),
            counted(len(self.loads), "load"),
            counted(len(self.coordinates), "coordinate"),
        ]
        if self.quasi_velocities:
            parts.append(counted(len(self.quasi_velocities), "quasi-velocity"))
        if self.states:
            parts.append(counted(len(self.states), "state"))
        if self.constraints:
            parts.append(counted(len(self.constraints), "constraint"))
        return f"System({', '.join([self.name, *parts] if self.name else parts)})"


def _label(thing: Body | Load, number: int) -> str:
    """Return the name of a body or a load, or its kind and its number."""
    return thing.name or f"{type(thing).__name__} {number}"


def _ordered(things: Collection[Thing]) -> tuple[Thing, ...]:
    return (
        tuple(sorted(things, key=lambda thing: thing.key))
        if isinstance(things, set | frozenset)
        else tuple(things)
    )


def _check_single(things: Sequence[object], kind: str) -> None:
    if len(set(things)) < len(things):
        twice = next(thing for thing in things if things.count(thing) > 1)
        raise ModelError(f"System: {kind} {brief(twice)} is given twice; give it once")


def _completed(given: Sequence[Expr], needed: Iterable[Expr]) -> tuple[Expr, ...]:
    """Return what is needed and not given, then what is given."""
    listed = tuple(expression(each) for each in given)
    return (*(each for each in dict.fromkeys(needed) if each not in listed), *listed)


def _parts(system: System) -> tuple[Any, ...]:
    gravity = () if system.gravity is None else (system.gravity,)
    rates = tuple(system.state_rates.values())
    return system.bodies, system.loads, system.conditions, system.inputs, rates, *gravity


def _rebuilt(system: System, parts: Sequence[Any]) -> System:
    bodies, loads, constraints, inputs, rates, *gravity = parts
    return System(
        bodies,
        loads,
        system.coordinates,
        constraints,
        gravity[0] if gravity else None,
        speeds=system.quasi_velocities,
        multipliers=system.multipliers,
        inputs=[each for each in inputs if each.kind == "time_function"],
        states=dict(zip(system.states, rates, strict=True)),
        name=system.name,
    )


def _check_substitution(system: System, mapping: Mapping[Any, Any]) -> None:
    """Raise an error for a substitution that would leave the system without its unknowns."""
    unknowns = (*system.coordinates, *system.quasi_velocities, *system.states, *system.multipliers)
    unknown = {each.name for each in unknowns}
    for key in mapping:
        if isinstance(key, Expr) and key.kind == "time_function" and key.name in unknown:
            raise ModelError(
                f"subs: {key} is an unknown of {brief(system)}; expected parameters and inputs. Substitute in "
                "expressions of the system, such as equations.residuals"
            )


contains(
    System,
    Container(
        _parts, _rebuilt, advice="the residuals of its equations of motion have one", subs=_check_substitution
    ),
)
