"""Systems: bodies and loads, and the coordinates in which they move."""

from __future__ import annotations

import warnings
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from copy import copy
from functools import cached_property
from importlib import import_module
from itertools import count
from types import MappingProxyType
from typing import Annotated, Any, TypeAlias, TypeVar, final

from symbody.errors import ConstraintError, ModelError, ModelNotice
from symbody.geometry import Frame, Vector
from symbody.geometry.component.triple import expression
from symbody.geometry.given.argument import checked
from symbody.symbolic import Expr, functions_of_time, substitute, time_derivative
from symbody.symbolic.expression.container import Container, contains
from symbody.symbolic.expression.html_table import html_table
from symbody.symbolic.given.arguments import brief, counted

from .body import Body
from .chosen_speeds import Choice, GivenUnknowns, chosen_rates, defined_speeds
from .constraint import Condition, as_constraint
from .constraint_fault import Unknowns, fault_of, is_on_velocity
from .coordinate import check_function_of_time, check_single
from .frames import all_frames
from .load import COLUMNS, Action, Load
from .oversight import notices
from .physical_inertia import report_impossible_differences
from .picture import picture
from .system_kinematics import SystemKinematics

Thing = TypeVar("Thing", Body, Load)

COUNTED_BY = "symbody.simulation.constraint.mobility"
"""What counts degrees of freedom in numbers: a module name, not an import, as the layer is above this one."""


Bodies: TypeAlias = Annotated[Collection[Body], "a list of bodies, such as [Body(frame, mass)]"]
Loads: TypeAlias = Annotated[
    Collection[Load], "a list of forces and torques, such as [Torque(frame, x, y, z, on=body)]"
]
Coordinates: TypeAlias = Annotated[
    Sequence[Expr], "a list of functions of time, such as functions_of_time('x y')"
]
Conditions: TypeAlias = Annotated[
    Sequence[Condition],
    "a list of expressions that are zero, such as [x**2 + y**2 - l**2]",
]


@final
class System(SystemKinematics):
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
        speeds: the functions of time that are velocities in moving frames, or that the kinematics holds
            (quasi-velocities); those of floating frames and definitions come first unless they are listed.
        kinematics: rates of coordinates by the speeds, ``{x': u1 - r*u2}``, or definitions of speeds by the rates,
            ``{u1: x'*cos(phi) + y'*sin(phi)}``, which are solved for rates; both linear.
        multipliers: one function of time per constraint; ``lambda1``, ``lambda2``, ... by default.
        inputs: the functions of time in frames and constraints that are given from outside. Unlisted ones are inputs
            too, but a notice names them: they may be forgotten coordinates. Functions of time in loads need no list.
        name: what the system is called.

    >>> from symbody import Body, System, Vector, functions_of_time, ground, rotate, symbols, t, translate
    >>> theta, (m, l, g) = functions_of_time("theta"), symbols("m l g")
    >>> bob = Body(rotate("Z", theta) * translate(0, -l, 0), m)
    >>> pendulum = System([bob], coordinates=[theta], gravity=Vector(ground, 0, -g, 0), name="pendulum")
    >>> pendulum
    System(pendulum, 1 body, 0 loads, 1 coordinate)
    >>> pendulum.speeds
    (theta',)

    By a speed of its own, the velocity of the bob, ``v = l theta'``:

    >>> v = functions_of_time("v")
    >>> by_v = System([bob], coordinates=[theta], kinematics={v: l * theta.diff(t)})
    >>> by_v.speeds, by_v.kinematics
    ((v,), {theta': v/l})
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
        kinematics: Choice = MappingProxyType({}),
        multipliers: Coordinates = (),
        inputs: Coordinates = (),
        name: str = "",
    ) -> None:
        self.bodies: tuple[Body, ...] = _ordered(bodies)
        self.loads: tuple[Load, ...] = _ordered(loads)
        self.gravity = gravity
        self._frames = all_frames(self.bodies, self.loads, gravity)
        motions = [frame.motion for frame in self._frames if frame.motion is not None]
        floating = {q: rate for motion in motions for q, rate in motion.coordinate_rates.items()}
        self.coordinates = _completed(coordinates, floating)
        defined = defined_speeds(self.coordinates, kinematics)
        self.quasi_velocities = _completed(
            speeds, [*(u for motion in motions for u in motion.speeds), *defined]
        )
        chosen = chosen_rates(GivenUnknowns(self.coordinates, self.quasi_velocities, floating), kinematics)
        self.coordinate_rates = floating | chosen
        self.chosen = tuple(chosen)
        """The coordinates whose rates are written by speeds of the user's choice."""
        self.conditions = tuple(as_constraint(constraint) for constraint in constraints)
        """The constraints as values, with their names and what they connect."""
        self.name = name
        self.multipliers = tuple(multipliers) or self._default_multipliers()
        self.inputs = tuple(expression(each) for each in inputs)
        self.eliminated: dict[Expr, Expr] = {}
        """The speeds that constraints made dependent, each by the independent ones; none unless `eliminating` did."""
        self.whole = self
        """The system with the constraints by which speeds were eliminated; itself, if none were."""
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

    def mobility(
        self,
        parameters: Mapping[Expr, Any] | None = None,
        q: Mapping[Expr, Any] | None = None,
        **options: Any,
    ) -> Any:
        """Return the degrees of freedom, and the constraints that follow from others: see `symbody.mobility`.

        Args:
            parameters: the values of the symbols in the constraints, to look where the mechanism moves.
            q: coordinates at a position, or near one.
            options: the time `t` and the `inputs`.

        >>> from symbody import Body, System, functions_of_time, translate
        >>> x, y = functions_of_time("x y")
        >>> System([Body(translate(x, y, 0), 1)], coordinates=[x, y], constraints=[x * y - 1]).mobility()
        Mobility(1 degree of freedom, 0 redundant)
        """
        return import_module(COUNTED_BY).mobility(self, parameters, q, **options)

    def eliminating(self, dependent: Mapping[Expr, Expr]) -> System:
        """Return the system in its independent speeds, without constraints.

        The coordinates stay; the rates of some are no longer speeds. Frames keep the dependent speeds: `by_speeds`
        writes expressions without them.

        Args:
            dependent: the other speeds by the independent ones, coordinates and time, as the constraints demand.
        """
        reduced = copy(self)
        members = (member for kind in type(self).__mro__ for member in vars(kind).items())
        for name in (name for name, value in members if isinstance(value, cached_property)):
            vars(reduced).pop(name, None)
        rates = zip(
            self.coordinate_rates, substitute([*self.coordinate_rates.values()], dependent), strict=True
        )
        linked = {
            q: dependent[time_derivative(q)] for q in self.coordinates if time_derivative(q) in dependent
        }
        reduced.coordinate_rates = {**dict(rates), **linked}
        reduced.quasi_velocities = tuple(u for u in self.quasi_velocities if u not in dependent)
        reduced.conditions, reduced.multipliers = (), ()
        reduced.eliminated, reduced.whole = dict(dependent), self
        return reduced

    def _check(self) -> None:
        if not self.bodies:
            raise ModelError("System: no bodies; give at least one")
        check_single(self.bodies, "the body")
        check_single(self.loads, "the load")
        self._check_gravity()
        self._check_unknowns()
        self._check_constraints()
        self._check_multipliers()
        self._check_inputs()
        report_impossible_differences(self.bodies)
        known = (*self.coordinates, *self.quasi_velocities, *self.inputs)
        for notice in notices(self.bodies, self.loads, self.constraints, known):
            warnings.warn(f"System: {notice}", ModelNotice, stacklevel=4)

    def _check_inputs(self) -> None:
        for given in self.inputs:
            check_function_of_time(given, "System: the input")
            if given in (*self.coordinates, *self.quasi_velocities, *self.multipliers):
                raise ModelError(
                    f"System: {given} is an input and unknown; leave it out of inputs, or of coordinates, speeds and "
                    "multipliers"
                )

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
        check_single(self.multipliers, "the multiplier")
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
        return frozenset({*self.coordinates, *self.quasi_velocities}).union(
            *(value.free_symbols for value in self._values())
        )

    def _names(self) -> frozenset[str]:
        return frozenset(leaf.name for leaf in self.leaves if leaf.kind != "application")

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
        names = {"coordinates": self.coordinates, "speeds": self.quasi_velocities, "inputs": self.inputs}
        unknowns = [(kind, ", ".join(map(str, each))) for kind, each in names.items() if each]
        tables.append(html_table("", ["unknowns", "names"], unknowns))
        if self.chosen:
            rates = [[time_derivative(q), self.coordinate_rates[q]] for q in self.chosen]
            tables.append(html_table("", ["rate", "by the speeds"], rates))
        if self.constraints:
            pairs = zip(self.conditions, self.multipliers, strict=True)
            rows = [[c.name, f"{c.condition} = 0", each] for c, each in pairs]
            tables.append(html_table("", ["name", "constraint", "multiplier"], rows))
        return "".join([*tables, picture(self)])

    def __repr__(self) -> str:
        parts = [
            counted(len(self.bodies), "body"),
            counted(len(self.loads), "load"),
            counted(len(self.coordinates), "coordinate"),
        ]
        if self.quasi_velocities:
            parts.append(counted(len(self.quasi_velocities), "quasi-velocity"))
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


def _completed(given: Sequence[Expr], needed: Iterable[Expr]) -> tuple[Expr, ...]:
    """Return what is needed and not given, then what is given."""
    listed = tuple(expression(each) for each in given)
    return (*(each for each in dict.fromkeys(needed) if each not in listed), *listed)


def _parts(system: System) -> tuple[Any, ...]:
    gravity = () if system.gravity is None else (system.gravity,)
    rates, conditions = (
        tuple(system.whole.coordinate_rates[q] for q in system.chosen),
        system.whole.conditions,
    )
    return (
        system.bodies,
        system.loads,
        conditions,
        system.inputs,
        (*rates, *system.eliminated.values()),
        *gravity,
    )


def _rebuilt(system: System, parts: Sequence[Any]) -> System:
    bodies, loads, constraints, inputs, expressions, *gravity = parts
    rates, dependent = expressions[: len(system.chosen)], expressions[len(system.chosen) :]
    whole = System(
        bodies,
        loads,
        system.coordinates,
        constraints,
        gravity[0] if gravity else None,
        speeds=system.whole.quasi_velocities,
        kinematics={time_derivative(q): rate for q, rate in zip(system.chosen, rates, strict=True)},
        multipliers=system.whole.multipliers,
        inputs=[each for each in inputs if each.kind == "time_function"],
        name=system.name,
    )
    pairs = dict(zip(system.eliminated, dependent, strict=True))
    return whole.eliminating(pairs) if pairs else whole


def _check_substitution(system: System, mapping: Mapping[Any, Any]) -> None:
    """Raise an error for a substitution that would leave the system without its unknowns."""
    unknown = {each.name for each in (*system.coordinates, *system.quasi_velocities, *system.multipliers)}
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
