"""What holds a body or a part: a force and a moment about a point."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import final

from symbody.dynamics.recursion.part_wrench import part_wrench
from symbody.errors import ModelError
from symbody.geometry import Frame, Point, Vector, cross, origin
from symbody.geometry.given.argument import checked
from symbody.multibody import Body, Load, System
from symbody.multibody.data_sheet import DataSheet, Row, WithSheet
from symbody.symbolic.expression.container import Container, contains
from symbody.symbolic.given.arguments import brief

from .euler import euler_equations
from .newton import newton_equations

__all__ = ["Reaction", "on_part"]


@final
@dataclass(frozen=True, eq=False)
class Reaction(WithSheet):
    """A force and a moment on a body, by what holds it.

    Attributes:
        force: the force on the body.
        moment: the moment about the point, without that of the force.
        at: the point, which is that of the force.
        on: the name of the body or of the part on which they act.

    >>> from symbody import Link, Vector, assemble, fixed, ground, newton_euler, prismatic, reaction, symbols
    >>> m, g, l = symbols("m g l")
    >>> lift, arm = Link("lift", m), Link("arm", m, center=(l, 0, 0))
    >>> A, B = prismatic("A", ground, lift, axis="Z"), fixed("B", lift, arm)
    >>> equations = newton_euler(assemble([A, B]).system(gravity=Vector(ground, 0, 0, -g)))
    >>> weld = reaction(equations, B)
    >>> weld.force.components[2], weld.moment.components
    (m*(s_A'' + g), (0, -l*m*(s_A'' + g), 0))
    """

    force: Vector
    moment: Vector
    at: Point
    on: str

    @checked(ModelError)
    def about(self, point: Point) -> Reaction:
        """Return the same action, by the moment about another point and the force there."""
        return Reaction(self.force, self.moment + cross(self.at - point, self.force), point, self.on)

    def projected(self, frame: Frame) -> Reaction:
        """Return the same action in the axes of another frame."""
        return Reaction(self.force.projected(frame), self.moment.projected(frame), self.at, self.on)

    @property
    def sheet(self) -> DataSheet:
        """What is shown of it: its components, the point of the moment, and the axes."""
        components = zip(_COMPONENTS, (*self.force.components, *self.moment.components), strict=True)
        point, axes = brief(self.at), brief(self.force.frame)
        given = f"reaction on {self.on} about {point}, in the axes of {axes}"
        return DataSheet(given, tuple(Row(name, value) for name, value in components))

    def __neg__(self) -> Reaction:
        return Reaction(-self.force, -self.moment, self.at, self.on)

    def __repr__(self) -> str:
        force, moment = (", ".join(map(brief, v.components)) for v in (self.force, self.moment))
        place, axes = brief(self.at), brief(self.force.frame)
        return f"Reaction(on {self.on}: force {force}, moment {moment} about {place}, in the axes of {axes})"


_COMPONENTS = ("Fx", "Fy", "Fz", "Mx", "My", "Mz")

contains(
    Reaction,
    Container(
        parts=lambda each: (each.force, each.moment, each.at),
        rebuilt=lambda each, parts: Reaction(parts[0], parts[1], parts[2], each.on),
        advice="its force and its moment have one",
    ),
)


def on_part(system: System, bodies: Sequence[Body], about: Point | None, frame: Frame | None) -> Reaction:
    """Return what holds bodies beside the loads and the weight: ``sum(m a) - sum(F) - sum(m g)``, and of moments."""
    at = about
    if at is None:
        at = _center(bodies[0]) if len(bodies) == 1 else origin(system.root)
    axes = system.root if frame is None else frame
    name = ", ".join(map(str, bodies))
    if all(body.frame.is_rigid for body in bodies):
        return Reaction(*part_wrench(system, bodies, at, axes), at, name)
    loads = [load for load in system.loads if any(action.body in bodies for action in load.actions)]
    members: list[Body | Load] = [*bodies, *loads]
    force = newton_equations(members, axes, gravity=system.gravity)
    moment = euler_equations(members, at, axes, gravity=system.gravity)
    return Reaction(force, moment, at, name)


def _center(body: Body) -> Point:
    return Point(body.frame, 0, 0, 0, name=f"centre of {body}")
