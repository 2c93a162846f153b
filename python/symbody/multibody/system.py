"""Systems: bodies and loads, and the coordinates in which they move."""

from __future__ import annotations

import warnings
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from importlib import import_module
from types import MappingProxyType
from typing import Annotated, Any, TypeAlias, TypeVar, final

from symbody.deferred import cached_property
from symbody.errors import ArgumentError, ModelError, ModelNotice
from symbody.geometry import Frame, Vector
from symbody.geometry.component.triple import expression
from symbody.geometry.given.argument import checked
from symbody.symbolic import Expr, time_derivative
from symbody.symbolic.expression.container import Container, contains
from symbody.symbolic.expression.html_table import html_table
from symbody.symbolic.given.arguments import brief, counted, unknown_option

from .body import Body
from .chosen_speeds import Choice, GivenUnknowns, chosen_rates, defined_speeds
from .frames import all_frames
from .load import COLUMNS, Action, Load
from .oversight import notices
from .physical_inertia import report_impossible_differences
from .picture import picture
from .state import Unknown, all_rates, check_constraints, check_holders, check_kinematics, check_states
from .variables import Conditions, Coordinates, Variables, check_substitution
from .well_posed import check_single

Thing = TypeVar("Thing", Body, Load)

COUNTED_BY = "symbody.simulation.constraint.mobility"
"""What counts degrees of freedom in numbers: a module name, not an import, as the layer is above this one."""
_COUNTED_WITH = ("parameters", "q", "t", "inputs")
"""The arguments that it takes."""


Bodies: TypeAlias = Annotated[Collection[Body], "a list of bodies, such as [Body(frame, mass)]"]
Loads: TypeAlias = Annotated[
    Collection[Load], "a list of forces and torques, such as [Torque(frame, x, y, z, on=body)]"
]

Rates: TypeAlias = Annotated[
    Mapping[Expr, object],
    "a dictionary of functions of time and their rates, such as {z: (x - z)/T}",
]


@final
class System(Variables):
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
        states: functions of time z beside the mechanics, which loads may hold, each with its rate z': an expression of
            time, coordinates, speeds, accelerations, multipliers, states, inputs and parameters. Those of loads, such
            as tyres, are added.
        joints: the joints that `assemble` placed, by which `reaction` knows where to cut.
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

    where = "System"
    contents = "a frame, a load or a constraint"
    whole: System

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
        states: Rates | None = None,
        joints: Sequence[object] = (),
        name: str = "",
    ) -> None:
        self.bodies: tuple[Body, ...] = _ordered(bodies)
        self.loads: tuple[Load, ...] = _ordered(loads)
        self.gravity = gravity
        self.joints: tuple[Any, ...] = tuple(joints)
        """The placed joints: of a class that is made of systems, and therefore unknown here."""
        self._frames = all_frames(self.bodies, self.loads, gravity)
        motions = [frame.motion for frame in self._frames if frame.motion is not None]
        floating = {q: rate for motion in motions for q, rate in motion.coordinate_rates.items()}
        unknowns = _completed(coordinates, floating)
        defined = defined_speeds(unknowns, kinematics)
        known = _completed(speeds, [*(u for motion in motions for u in motion.speeds), *defined])
        given = [motion.twist for motion in motions] + [frame.carrier for frame in self._frames]
        twists = [v for twist in given if twist is not None for v in (*twist.angular, *twist.linear)]
        chosen = chosen_rates(GivenUnknowns(unknowns, known, floating, twists), kinematics)
        self.chosen = tuple(chosen)
        """The coordinates whose rates are written by speeds of the user's choice."""
        super().__init__(
            unknowns,
            floating | chosen,
            speeds=known,
            constraints=constraints,
            multipliers=multipliers,
            inputs=inputs,
            states=all_rates(states, self.loads),
            name=name,
        )
        self.check()

    @cached_property
    def root(self) -> Frame:
        """The frame to which all bodies are attached: ground, or a moving master frame."""
        return self.bodies[0].frame.ancestor

    @cached_property
    def actions(self) -> tuple[Action, ...]:
        """The actions of the loads on the bodies of the system; actions on other bodies are left out."""
        members = {*self.bodies}
        return tuple(action for load in self.loads for action in load.actions if action.body in members)

    def with_loads(self, loads: Loads) -> System:
        """Return the system with other loads; the states of those that it had stay."""
        bodies, _, *others = _parts(self)
        return _rebuilt(self, [bodies, loads, *others])

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
        for name in options:
            if name not in _COUNTED_WITH:
                raise ArgumentError(f"System.mobility: {unknown_option(name, _COUNTED_WITH)}")
        return import_module(COUNTED_BY).mobility(self, parameters, q, **options)

    def check(self) -> None:
        """Check that bodies, loads and gravity belong together, and the variables.

        Raises:
            ModelError: something is missing, given twice, or of another kind.
            ConstraintError: a constraint is no condition on positions or velocities, or a multiplier is something else.
        """
        if not self.bodies:
            raise ModelError("System: no bodies; give at least one")
        check_single(self.bodies, "System: the body")
        check_single(self.loads, "System: the load")
        self._check_gravity()
        super().check()
        self._check_states()
        report_impossible_differences(self.bodies)
        known = (*self.coordinates, *self.quasi_velocities, *self.inputs, *self.states)
        rates = [self.coordinate_rates[q] for q in self.chosen]
        unknown = (*self.coordinates, *self.quasi_velocities)
        for notice in notices(self.bodies, self.loads, self.constraints, known, rates, unknown, self.inputs):
            warnings.warn(f"System: {notice}", ModelNotice, stacklevel=4)

    def _check_states(self) -> None:
        unknown = Unknown(self.coordinates, self.quasi_velocities, self.multipliers, self.inputs)
        check_states(self._given_rates, unknown)
        check_kinematics(self._given_rates, {q: self.coordinate_rates[q] for q in self.chosen}, unknown)
        check_constraints(self._given_rates, self.conditions, self.holonomic, unknown)
        check_holders(self._given_rates, self._frames, self.gravity, self.loads, unknown)

    def _check_gravity(self) -> None:
        if self.gravity is not None and self.gravity.frame.ancestor != self.root:
            raise ModelError(
                f"System: the gravity is given in {brief(self.gravity.frame)}, which can't be seen from {self.root}, "
                f"on which the bodies hang; give its components in {self.root}"
            )

    def _values(self) -> Iterator[Expr]:
        yield from (*self.constraints, *self.coordinate_rates.values())
        for body in self.bodies:
            yield from (body.mass, *body.moments, *body.products)
        for action in (action for load in self.loads for action in load.actions):
            yield from action.vector.components
            if action.point is not None:
                yield from action.point.coordinates
        for joint in self.joints:
            yield from (
                bound for limit in joint.limits for bound in (limit.low, limit.high) if bound is not None
            )
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
            [_label(load, k), *row[:-1], labels.get(action.body, action.body)]
            for k, load in enumerate(self.loads, start=1)
            for row, action in zip(load.rows, load.actions, strict=True)
        ]
        if self.gravity is not None:
            components = ", ".join(map(brief, self.gravity.components))
            loads.append(["gravity", "acceleration", components, self.gravity.frame, "", "all bodies"])
        if loads:
            tables.append(html_table("", ["load", *COLUMNS], loads))
        names = {
            "coordinates": self.coordinates,
            "momenta" if self.momenta else "speeds": self.quasi_velocities,
            "states": self.states,
            "inputs": self.inputs,
        }
        unknowns = [(kind, ", ".join(map(str, each))) for kind, each in names.items() if each]
        tables.append(html_table("", ["unknowns", "names"], unknowns))
        if self.chosen:
            rates = [[time_derivative(q), self.coordinate_rates[q]] for q in self.chosen]
            tables.append(html_table("", ["rate", "by the speeds"], rates))
        if self.states:
            tables.append(
                html_table("", ["rate", "of a state"], [[*pair] for pair in self.state_rates.items()])
            )
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
            n = len(self.quasi_velocities)
            momenta = "momentum" if n == 1 else "momenta"
            parts.append(f"{n} {momenta}" if self.momenta else counted(n, "quasi-velocity"))
        if self.states:
            parts.append(counted(len(self.states), "state"))
        if self.constraints:
            parts.append(counted(len(self.constraints), "constraint"))
        return f"System({', '.join([self.name, *parts] if self.name else parts)})"


def _label(thing: Body | Load, number: int) -> str:
    """Return the name of a body or a load, or its kind and its number."""
    kind = thing.label if isinstance(thing, Load) else type(thing).__name__
    return thing.name or f"{kind} {number}"


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
        system.joints,
        (*rates, *system.eliminated.values(), *system.momenta.values(), *system.whole.state_rates.values()),
        *gravity,
    )


def _rebuilt(system: System, parts: Sequence[Any]) -> System:
    bodies, loads, constraints, inputs, joints, expressions, *gravity = parts
    remaining = iter(expressions)
    rates, speeds, momenta = (
        dict(zip(names, remaining, strict=False))
        for names in (map(time_derivative, system.chosen), system.eliminated, system.momenta)
    )
    whole = System(
        bodies,
        loads,
        system.coordinates,
        constraints,
        gravity[0] if gravity else None,
        speeds=system.whole.quasi_velocities,
        kinematics=rates,
        multipliers=system.whole.multipliers,
        inputs=[each for each in inputs if each.kind == "time_function"],
        states=dict(zip(system.states, remaining, strict=True)),
        joints=joints,
        name=system.name,
    )
    if system.left_out:
        whole = whole.leaving_out([whole.multipliers.index(each) for each in system.left_out], system.borne)
    return whole.eliminating(speeds, momenta) if speeds else whole


contains(
    System,
    Container(
        _parts, _rebuilt, advice="the residuals of its equations of motion have one", subs=check_substitution
    ),
)
