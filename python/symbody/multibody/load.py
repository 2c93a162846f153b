"""Loads: forces and torques on bodies."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from copy import copy
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any, Self, final

from symbody.deferred import cached_property
from symbody.errors import LoadError
from symbody.geometry import Frame, Point, Scalar, Triple, Vector
from symbody.geometry.frame.coordinates import path
from symbody.geometry.frame.frame_velocity import Seen, material_velocity, spin
from symbody.geometry.given.argument import checked
from symbody.symbolic import ENERGY, Expr, derivation, dot3, number
from symbody.symbolic.expression.container import Container, contains
from symbody.symbolic.expression.html_table import html_table
from symbody.symbolic.given.arguments import brief, counted

from .body import Body


@dataclass(frozen=True, eq=False)
class Action:
    """The action of a load on one body: a force at a point of it, or a torque.

    Attributes:
        body: on which it acts.
        vector: the force or the torque.
        point: where a force acts; None for a torque.

    >>> from symbody import Body, Torque, functions_of_time, ground, rotate, symbols
    >>> rotor, M = Body(rotate("Z", functions_of_time("phi")), 1, Iz=1), symbols("M")
    >>> [action.is_force for action in Torque(ground, 0, 0, M, on=rotor).actions]
    [False]
    """

    body: Body
    vector: Vector
    point: Point | None = None

    @property
    def key(self) -> bytes:
        """A digest of what acts, and where, by which loads can be put in order."""
        place = () if self.point is None else self.point.coordinates
        values = b"".join(value.fingerprint for value in (*self.vector.components, *place))
        return self.body.key + self.vector.frame.key + values

    @property
    def is_force(self) -> bool:
        """Whether this is a force, not a torque."""
        return self.point is not None

    @property
    def anchor(self) -> Point:
        """The point of a force by its coordinates in a frame that is fixed in the body; its own frame if that is."""
        point = self.point or self.body.center_of_mass
        up, down = path(point.frame, self.body.frame)
        fixed = all(motion.is_constant for motion in (*up, *down))
        return point if fixed else point.projected(self.body.frame)

    @property
    def fields(self) -> Mapping[str, object]:
        """What `show` prints of it, by MBSymba's names of the fields."""
        applied = {} if self.point is None else {"applied": self.point}
        return {"frame": self.vector.frame, "comps": self.vector.components, **applied, "acting": self.body}

    @property
    def row(self) -> tuple[object, ...]:
        """What a notebook shows of it; `COLUMNS` has the header."""
        components = ", ".join(map(brief, self.vector.components))
        kind, point = ("torque", "") if self.point is None else ("force", self.point)
        return kind, components, self.vector.frame, point, self.body

    def components(self, axes: Frame) -> Triple:
        """Return the components of the force or torque."""
        return self.vector.projected(axes).components

    def projected(self, frame: Frame) -> Action:
        """Return the same action, by the components of its vector in another frame."""
        return Action(self.body, self.vector.projected(frame), self.point)


COLUMNS = ("kind", "components", "in the axes of", "at", "on")
"""The header of the table of the actions of a load."""


class Load(ABC):
    """A load on bodies: the sum of its actions.

    Most loads are elements: functions that return an `Element` (docs/extending.md). Another kind of load is one file
    with a final subclass that has `actions`, a cached property. Its power, its generalised forces, its part in all
    equations and what `show` prints follow from them.

    >>> from symbody import Body, Force, functions_of_time, ground, symbols, translate
    >>> (x, y), F = functions_of_time("x y"), symbols("F")
    >>> a, b = Body(translate(x, 0, 0), 1, name="a"), Body(translate(y, 0, 0), 1, name="b")
    >>> thrust = Force(ground, F, 0, 0, at=a.center_of_mass, on=a, reaction=b)
    >>> [(action.body, action.vector) for action in thrust.actions]
    [(a, Vector(ground, F, 0, 0)), (b, Vector(ground, -F, 0, 0))]
    """

    name: str = ""
    potential: Expr | None = None
    """The potential energy whose loss is in the power of the load; None if there is none, or it is unknown."""
    states: Mapping[Expr, Expr] = MappingProxyType({})
    """The functions of time beside the mechanics that the load brings along, and their rates."""
    far_end: Point | Frame | None = None
    """The place at the other end where no body reacts; None if one does, or the place is unknown."""

    @property
    @abstractmethod
    def actions(self) -> tuple[Action, ...]:
        """The actions of the load, body by body."""

    def _repr_html_(self) -> str:
        return html_table(self.label, COLUMNS, self.rows)

    @property
    def label(self) -> str:
        """What the load is called in tables: its name, or its kind."""
        return self.name or type(self).__name__

    @property
    def rows(self) -> list[tuple[object, ...]]:
        """What a notebook shows of it, action by action."""
        return [action.row for action in self.actions]

    @property
    def between_ends(self) -> tuple[Expr, ...]:
        """What the motions of both ends change, such as the potential energy."""
        return () if self.potential is None else (self.potential,)

    @property
    def key(self) -> bytes:
        """The sort key of the loads of a set."""
        return self.name.encode() + b"".join(action.key for action in self.actions)

    @property
    def fields(self) -> Mapping[str, object]:
        """What `show` prints of the load, by the names of the fields."""
        return {"actions": self.actions}

    @checked(LoadError)
    def projected(self, frame: Frame) -> Self:
        """Return the same load, by the components of its actions in another frame.

        Raises:
            LoadError: the class of the load computes its actions at each use, so that others cannot be stored.
        """
        return self.acting(tuple(action.projected(frame) for action in self.actions), "project")

    def acting(self, actions: tuple[Action, ...], operation: str) -> Self:
        """Return the same load with its actions in another form."""
        same = copy(self)
        vars(same)["actions"] = actions
        if same.actions is not actions:
            raise LoadError(
                f"{operation}: {type(self).__name__}.actions is computed at each use; expected a cached_property, "
                f"whose value can be replaced by the {operation}ed actions"
            )
        return same

    def __repr__(self) -> str:
        bodies = ", ".join(map(str, dict.fromkeys(action.body for action in self.actions)))
        return self.name or f"{type(self).__name__}(on {bodies})"


class _Vectorial(Load):
    """A vector that acts on a body, and with the opposite sign on a reaction body.

    Args:
        what: the vector, or the frame of its components.
        components: three, if a frame is given.
        on: the body on which it acts.
        reaction: the body on which the opposite vector acts.
        name: what the load is called where it is shown.
    """

    def __init__(
        self, what: Vector | Frame, components: tuple[Scalar, ...], on: Body, reaction: Body | None, name: str
    ) -> None:
        kind = type(self).__name__
        if isinstance(what, Vector) and not components:
            self.vector = what
        elif isinstance(what, Frame) and len(components) == 3:
            self.vector = Vector(what, *components)
        else:
            raise LoadError(
                f"{kind}: {brief(what)} with {counted(len(components), 'component')}, expected a vector "
                "alone, or a frame and three components"
            )
        if on is reaction:
            raise LoadError(
                f"{kind}: acts and reacts on the same body {brief(on)}; name two bodies, or leave reaction out"
            )
        self.on, self.reaction, self.name = on, reaction, name

    @property
    def frame(self) -> Frame:
        """The frame in which the components are given."""
        return self.vector.frame

    @property
    def components(self) -> Triple:
        """The components of the vector."""
        return self.vector.components

    @property
    def fields(self) -> Mapping[str, object]:
        """What `show` prints of the load, by MBSymba's names of the fields."""
        reacting = {} if self.reaction is None else {"reacting": self.reaction}
        return {**self.actions[0].fields, **reacting}

    @property
    def key(self) -> bytes:
        """The sort key of the loads of a set."""
        values = b"".join(component.fingerprint for component in self.vector.components)
        return self.name.encode() + self.on.key + self.vector.frame.key + values


@final
class Force(_Vectorial):
    """A force at a point of a body: ``Force(vector, at=P, on=body)`` or ``Force(frame, x, y, z, at=P, on=body)``.

    The power of the force is that on the material point of the body that is at the point at the instant. The reaction
    acts at the same place on the reaction body.

    A `System` tells of a point at rest, or on another body, from which the body moves away: either the frame of the
    point is the wrong one, or the force acts on ever other points, as that of a jet. What exerts it is then given as
    `reaction`.

    Args:
        what: the force as a vector, or the frame of its components.
        components: three, if a frame is given.
        at: the point where the force acts.
        on: the body on which it acts.
        reaction: the body on which the opposite force acts; none by default, such as the ground.
        name: what the force is called where it is shown.

    >>> from symbody import Body, Force, System, functions_of_time, ground, newton_euler, symbols, translate
    >>> x, (m, k) = functions_of_time("x"), symbols("m k")
    >>> slider = Body(translate(x, 0, 0), m)
    >>> spring = Force(ground, -k * x, 0, 0, at=slider.center_of_mass, on=slider)
    >>> newton_euler(System([slider], [spring], [x])).residuals
    (m*x'' + k*x,)
    """

    @checked(LoadError)
    def __init__(
        self,
        what: Vector | Frame,
        *components: Scalar,
        at: Point,
        on: Body,
        reaction: Body | None = None,
        name: str = "",
    ) -> None:
        super().__init__(what, components, on, reaction, name)
        self.at = at

    @cached_property
    def actions(self) -> tuple[Action, ...]:
        direct = Action(self.on, self.vector, self.at)
        return (direct,) if self.reaction is None else (direct, Action(self.reaction, -self.vector, self.at))

    @checked(LoadError)
    def projected(self, frame: Frame) -> Force:
        """Return the same force, by its components in another frame."""
        vector = self.vector.projected(frame)
        return Force(vector, at=self.at, on=self.on, reaction=self.reaction, name=self.name)

    def __repr__(self) -> str:
        return self.name or f"Force({self.vector}, at={self.at}, on={self.on})"


@final
class Torque(_Vectorial):
    """A torque on a body: ``Torque(vector, on=body)`` or ``Torque(frame, x, y, z, on=body)``.

    Args:
        what: the torque as a vector, or the frame of its components.
        components: three, if a frame is given.
        on: the body on which it acts.
        reaction: the body on which the opposite torque acts; none by default, such as the ground.
        name: what the torque is called where it is shown.

    >>> from symbody import Body, System, Torque, functions_of_time, ground, newton_euler, rotate, symbols
    >>> phi, (I, M) = functions_of_time("phi"), symbols("I M")
    >>> rotor = Body(rotate("Z", phi), 1, Iz=I)
    >>> newton_euler(System([rotor], [Torque(ground, 0, 0, M, on=rotor)], [phi])).residuals
    (I*phi'' - M,)
    """

    @checked(LoadError)
    def __init__(
        self,
        what: Vector | Frame,
        *components: Scalar,
        on: Body,
        reaction: Body | None = None,
        name: str = "",
    ) -> None:
        super().__init__(what, components, on, reaction, name)

    @cached_property
    def actions(self) -> tuple[Action, ...]:
        direct = Action(self.on, self.vector)
        return (direct,) if self.reaction is None else (direct, Action(self.reaction, -self.vector))

    @checked(LoadError)
    def projected(self, frame: Frame) -> Torque:
        """Return the same torque, by its components in another frame."""
        return Torque(self.vector.projected(frame), on=self.on, reaction=self.reaction, name=self.name)

    def __repr__(self) -> str:
        return self.name or f"Torque({self.vector}, on={self.on})"


def _same_load(load: Load, parts: Sequence[Any]) -> Load:
    return load.acting(tuple(parts), "convert")


def _action_parts(action: Action) -> tuple[Any, ...]:
    return action.body, action.vector, *(() if action.point is None else (action.point,))


def _vector(load: Force | Torque) -> tuple[Vector]:
    return (load.vector,)


def _force_parts(force: Force) -> tuple[Any, ...]:
    return force.vector, force.at, force.on, *(() if force.reaction is None else (force.reaction,))


def _torque_parts(torque: Torque) -> tuple[Any, ...]:
    return torque.vector, torque.on, *(() if torque.reaction is None else (torque.reaction,))


def _same_force(force: Force, parts: Sequence[Any]) -> Force:
    vector, at, on, *reaction = parts
    return Force(vector, at=at, on=on, reaction=reaction[0] if reaction else None, name=force.name)


def _same_torque(torque: Torque, parts: Sequence[Any]) -> Torque:
    vector, on, *reaction = parts
    return Torque(vector, on=on, reaction=reaction[0] if reaction else None, name=torque.name)


def _layout(load: Force | Torque, texts: list[str]) -> str:
    del load
    return texts[0]


_ADVICE = "its vector has one: diff(load.vector, x)"
contains(Action, Container(_action_parts, lambda _, parts: Action(*parts), advice=_ADVICE))
contains(Load, Container(lambda load: load.actions, _same_load, advice="the vectors of its actions have one"))
contains(Force, Container(_force_parts, _same_force, layout=_layout, shown=_vector, advice=_ADVICE))
contains(Torque, Container(_torque_parts, _same_torque, layout=_layout, shown=_vector, advice=_ADVICE))


@checked(LoadError)
def power(load: Load) -> Expr:
    """Return the power of a load: ``F . v + M . w``, summed over the bodies on which it acts.

    >>> from symbody import Body, Force, Point, functions_of_time, ground, symbols, translate
    >>> x, F = functions_of_time("x"), symbols("F")
    >>> body = Body(translate(x, 0, 0), 1)
    >>> power(Force(ground, F, 0, 0, at=body.center_of_mass, on=body))
    F*x'
    """
    with derivation(order=ENERGY):
        return sum((action_power(action) for action in load.actions), start=number(0))


def action_power(action: Action) -> Expr:
    """Return the power of one action."""
    velocity, axes = action_velocity(action)
    return dot3(action.components(axes), velocity)


def action_velocity(action: Action) -> Seen:
    """Return the velocity whose product with an action is its power: of the material point, or angular."""
    if not action.is_force:
        return Seen(spin(action.body.frame), action.body.frame)
    anchor = action.anchor
    return material_velocity(anchor.coordinates, anchor.frame)
