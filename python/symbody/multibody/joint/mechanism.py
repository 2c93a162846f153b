"""Mechanisms: links that are placed by joints."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from types import MappingProxyType
from typing import Annotated, TypeAlias, final

from symbody.errors import JointError
from symbody.geometry import Frame, Point, Scalar, Vector
from symbody.geometry.given.argument import checked
from symbody.multibody.body import Body
from symbody.multibody.constraint import Condition, Constraint
from symbody.multibody.data_sheet import DataSheet, Row
from symbody.multibody.system import Loads, System
from symbody.symbolic import Expr
from symbody.symbolic.expression.html_table import html_table
from symbody.symbolic.given.arguments import brief, counted

from .carried_body import carrying_links
from .idle_coordinate import check_idle_coordinates
from .joint import Joint
from .link import Link
from .placed_joint import PlacedJoint

__all__ = ["Mechanism"]

WhichLink: TypeAlias = Annotated[Link | str, "a link of the mechanism, or its name"]
WhichJoint: TypeAlias = Annotated[Joint | str, "a joint of the mechanism, or its name"]


@final
@dataclass(frozen=True, eq=False)
class Mechanism:
    """Links that are placed by joints: bodies with frames, coordinates, and the constraints of the loops.

    `assemble` makes it.

    Attributes:
        joints: the joints where they are placed, in the order given.
        places: the links with their frames.
        bodies: the bodies of the links, in the order in which the joints name them.
        coordinates: those of the joints that open the tree, in the order of the joints.

    >>> from symbody import Link, Vector, assemble, ground, newton_euler, revolute, symbols
    >>> m, l, g = symbols("m l g")
    >>> bob = Link("bob", m, center=(0, -l, 0))
    >>> pendulum = assemble([revolute("A", ground, bob)])
    >>> newton_euler(pendulum.system(gravity=Vector(ground, 0, -g, 0))).residuals
    (l*m*(l*phi_A'' + g*sin(phi_A)),)
    """

    joints: tuple[PlacedJoint, ...]
    places: tuple[tuple[Link, Frame], ...]
    bodies: tuple[Body, ...]
    coordinates: tuple[Expr, ...]

    @property
    def frames(self) -> dict[Link, Frame]:
        """The frames of the links, by link."""
        return dict(self.places)

    @cached_property
    def constraints(self) -> tuple[Constraint, ...]:
        """The conditions of the joints, by names such as ``A.x``; those that hold by themselves are left out."""
        bodies = {body.name: body for body in self.bodies}
        return tuple(
            Constraint(
                closure.condition,
                f"{joint.name}.{closure.name}",
                on=[bodies.get(name, frame) for name, frame in joint.ends],
            )
            for joint in self.joints
            for closure in joint.active
        )

    @checked(JointError)
    def frame(self, link: WhichLink) -> Frame:
        """Return the frame of a link."""
        return self.frames[self._link(link)]

    @checked(JointError)
    def body(self, link: WhichLink) -> Body:
        """Return the body of a link."""
        name = self._link(link).name
        return next(body for body in self.bodies if body.name == name)

    @checked(JointError)
    def point(self, link: WhichLink, x: Scalar, y: Scalar, z: Scalar, *, name: str = "") -> Point:
        """Return a point by its coordinates in the axes of a link.

        Args:
            link: the link, or its name.
            x: along the x axis of the link.
            y: along y.
            z: along z.
            name: what the point is called where it is shown.
        """
        return Point(self.frame(link), x, y, z, name=name)

    @checked(JointError)
    def joint(self, joint: WhichJoint) -> PlacedJoint:
        """Return a joint where it is placed."""
        for placed in self.joints:
            if joint is placed.joint or joint == placed.name:
                return placed
        raise JointError(
            f"Mechanism: no joint {brief(joint)}; expected one of {brief(', '.join(j.name for j in self.joints))}"
        )

    def _link(self, link: Link | str) -> Link:
        for placed in self.frames:
            if link is placed or link == placed.name:
                return placed
        raise JointError(
            f"Mechanism: no link {brief(link)}; expected one of {brief(', '.join(map(str, self.frames)))}"
        )

    @checked(JointError)
    def system(
        self,
        loads: Loads = (),
        *,
        gravity: Vector | None = None,
        bodies: Sequence[Body] = (),
        coordinates: Sequence[Expr] = (),
        speeds: Sequence[Expr] = (),
        constraints: Sequence[Condition] = (),
        inputs: Sequence[Expr] = (),
        states: Mapping[Expr, object] | None = None,
        kinematics: Mapping[Expr, Scalar] = MappingProxyType({}),
        name: str = "",
    ) -> System:
        """Return the system of the mechanism, and of what moves beside it.

        A body beside the links is carried by the link on whose frame its own is built, or by none; `reaction` counts it
        with this link.

        Args:
            loads: the forces and torques on its bodies.
            gravity: the acceleration of weight.
            bodies: bodies beside those of the links, each with a name of its own.
            coordinates: functions of time by which these bodies move, beside the coordinates of the joints.
            speeds: the velocities of moving frames among them, and other quasi-velocities; see `System`.
            constraints: conditions beside those of the joints, such as drives.
            inputs: functions of time that are given from outside; those of joints are no coordinates then.
            states: functions of time beside the mechanics and their rates.
            kinematics: rates by speeds, or definitions of speeds; see `System`.
            name: what the system is called.

        Raises:
            JointError: a body beside the links has no name of its own, or no link carries it although it moves by a
                coordinate of a joint; or a load or a constraint holds the coordinate of a joint that closes a loop.
        """
        carriers = carrying_links(bodies, self.frames, self.coordinates)
        listed = [*self.coordinates, *coordinates, *speeds, *inputs, *(states or ())]
        check_idle_coordinates(self.joints, loads, constraints, listed)
        return System(
            [*self.bodies, *bodies],
            loads,
            [*(q for q in self.coordinates if q not in inputs), *coordinates],
            [*self.constraints, *constraints],
            gravity,
            speeds=speeds,
            kinematics=kinematics,
            inputs=inputs,
            states=states,
            joints=[joint.carrying(carriers) for joint in self.joints],
            name=name,
        )

    def _repr_html_(self) -> str:
        """Return a table of the joints: what they join, their coordinates and their conditions."""
        rows = [
            [
                each,
                *(brief(part) for part in (each.joint.parent, each.joint.child)),
                ", ".join(map(str, each.coordinates)),
                ", ".join(f"{each.name}.{closure.name}" for closure in each.active),
            ]
            for each in self.joints
        ]
        return html_table(str(self), ["joint", "parent", "child", "coordinates", "constraints"], rows)

    def latex(self) -> str:
        """Return the coordinates and the constraints of the joints in LaTeX, without dollar signs."""
        conditions = (Row(each.name, each.condition, "= 0") for each in self.constraints)
        return DataSheet(str(self), (Row("coordinates", self.coordinates), *conditions)).latex

    def description(self) -> str:
        """Return what `show` prints: one line per joint, with its part in the spanning tree."""
        return "\n".join([str(self), *(joint.line for joint in self.joints)])

    def __repr__(self) -> str:
        parts = [
            counted(len(self.bodies), "body"),
            counted(len(self.joints), "joint"),
            counted(len(self.coordinates), "coordinate"),
            counted(len(self.constraints), "constraint"),
        ]
        return f"Mechanism({', '.join(parts)})"
