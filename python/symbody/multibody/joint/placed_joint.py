"""Joints where they are placed: frames on both sides, and what they hold."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Annotated, Any, TypeAlias, final

from symbody.errors import JointError
from symbody.geometry import Frame, Point
from symbody.geometry.given.argument import checked
from symbody.multibody.data_sheet import DataSheet, Row, WithSheet
from symbody.symbolic import Expr, cost
from symbody.symbolic.expression.container import Container, contains
from symbody.symbolic.given.arguments import brief, counted

from .closure import LONGEST, Closure, Sides, names_that_constrain
from .freedom import Freedom
from .joint import Joint
from .joint_angle import cone_angle
from .limit import CONE, Limit
from .link import Link

__all__ = ["PlacedJoint"]

FreedomName: TypeAlias = Annotated[
    str, "the name of a coordinate of the joint, such as 'phi', or nothing if it has one coordinate"
]


@final
@dataclass(frozen=True, eq=False)
class PlacedJoint(WithSheet):
    """A joint of a mechanism, with the frames on which it is.

    Attributes:
        joint: the joint as it was given.
        parent_side: its axes P on the parent.
        child_side: its axes C on the child.
        coordinates: those that place a link; empty where it closes a loop.
        closures: what it holds, and by which forces.
        constraining: the names of the closures that make constraints: those that don't hold by themselves.
        outboard: the names of the bodies beyond it, where it opens the tree; None where it closes a loop.
        limits: the least and the largest values of its coordinates.
        residuals: the sizes of conditions that were left out within a tolerance, by name.
    """

    joint: Joint
    parent_side: Frame
    child_side: Frame
    coordinates: tuple[Expr, ...]
    closures: tuple[Closure, ...]
    constraining: tuple[str, ...]
    outboard: tuple[str, ...] | None
    limits: tuple[Limit, ...] = ()
    residuals: Mapping[str, float] = field(default_factory=dict)

    @classmethod
    def of(cls, joint: Joint, sides: Sides, outboard: tuple[str, ...] | None) -> PlacedJoint:
        """Return a joint between frames; one that opens the tree leads to links."""
        opens = outboard is not None
        closures = joint.pair.opened(sides, joint.coordinates) if opens else joint.pair.closures(sides)
        placed = cls(
            joint,
            sides.parent,
            sides.child,
            joint.coordinates if opens else joint.pair.keeps,
            closures,
            () if opens and not joint.pair.rolls else names_that_constrain(closures),
            outboard,
        )
        given = {limit.name for limit in joint.limits}
        own = [limit for limit in joint.pair.own_limits if opens and limit.name not in given]
        return replace(placed, limits=tuple(map(placed.limit, [*joint.limits, *own])))

    @property
    def name(self) -> str:
        """The name of the joint."""
        return self.joint.name

    @property
    def coordinate(self) -> Expr:
        """The coordinate of a joint that has one.

        Raises:
            JointError: it has another number of coordinates, or none, because it closes a loop.
        """
        if len(self.coordinates) == 1:
            return self.coordinates[0]
        if self.opens:
            return self.joint.coordinate
        raise JointError(
            f"{self} closes a loop, and has no coordinate; expected that of a joint of the tree, or freedom(), which "
            "loads take in its place"
        )

    @property
    def opens(self) -> bool:
        """Whether it opens the tree; else it closes a loop."""
        return self.outboard is not None

    @property
    def sides(self) -> Sides:
        """Its axes on both sides."""
        return Sides(self.parent_side, self.child_side)

    @cached_property
    def measured(self) -> Mapping[str, Expr]:
        """The values of its coordinates by their names; where it closes a loop, those that the axes determine."""
        if self.opens:
            return dict(zip(self.joint.pair.names, self.coordinates, strict=True))
        return self.joint.pair.measured(self.sides)

    def carrying(self, carriers: Mapping[str, str]) -> PlacedJoint:
        """Return the joint with the bodies beyond it that are no links, by the names of the links that carry them."""
        if self.outboard is None:
            return self
        more = tuple(name for name, link in carriers.items() if link in self.outboard)
        return replace(self, outboard=(*self.outboard, *more)) if more else self

    def limit(self, limit: Limit) -> Limit:
        """Return a limit with the value that it limits.

        Raises:
            JointError: the joint closes a loop, where this value isn't known, or may jump within the limits.
        """
        value = cone_angle(self.sides.entry) if limit.name == CONE else self.measured.get(limit.name)
        if value is None:
            raise JointError(
                f"assemble: {self} closes a loop, where {limit.name} isn't known, and it has limits of it; let another "
                "joint close the loop by loop=True, or leave these limits out"
            )
        found = replace(limit, value=value)
        travel = None if self.opens or limit.name == CONE else self.joint.pair.travel(self.sides, limit.name)
        return found.within_a_turn(f"assemble: {self}") if travel is not None and travel.jumps else found

    def label(self, limit: Limit) -> str:
        """Return what limits are called: the joint alone where it has one coordinate."""
        return self.name if len(self.joint.coordinates) == 1 else f"{self.name}.{limit.name}"

    @checked(JointError)
    def freedom(self, name: FreedomName = "") -> Freedom:
        """Return a freedom, along which a motor, friction or a spring acts.

        Args:
            name: of the coordinate, such as "phi"; it may be left out if there is one.

        Raises:
            JointError: there is no such freedom, there are several, or it isn't known where the joint closes a loop.
        """
        names = self.joint.pair.names
        listed = f"expected one of {', '.join(map(repr, names))}" if names else "it lets nothing move"
        if name not in names and (name or len(names) != 1):
            what = f"no freedom {brief(repr(name))}" if name else counted(len(names), "freedom")
            raise JointError(f"{self}: {what}; {listed}")
        chosen = name or names[0]
        travel = self.joint.pair.travel(self.sides, chosen)
        if travel is None and not self.opens:
            known = [name for name in names if self.joint.pair.travel(self.sides, name) is not None]
            others = f"expected one of {', '.join(map(repr, known))}, or " if known else ""
            raise JointError(
                f"{self}: it closes a loop, where the motion along {chosen} isn't known; {others}let another joint "
                "close the loop by loop=True"
            )
        if self.opens and travel is not None:
            travel = travel._replace(jumps=False)  # the coordinate is the angle with all its turns
        (parent, one), (child, other) = self.ends
        value, ends, sides = self.measured[chosen], (parent, child), (one, other)
        is_driven = not any(leaf.kind == "time_function" for leaf in value.free_symbols)
        if self.opens and travel is not None and travel.is_rotation and not is_driven:
            travel = None  # the coordinate gives a shorter torque
        is_coordinate = self.opens or value in self.coordinates
        return Freedom(str(self), chosen, value, ends, sides, travel, is_coordinate=is_coordinate)

    @property
    def point(self) -> Point:
        """The point of the child at the joint, about which moments of reactions are given."""
        return Point(self.child_side, 0, 0, 0, name=self.name)

    @property
    def acting_point(self) -> Point:
        """The point of the reaction: that where wheels or teeth touch, which exert no moment there, or `point`."""
        first = next(iter(self.closures), None)
        at_one_place = first is not None and all(
            closure.at is first.at and all(entry.is_zero for entry in closure.moment.components)
            for closure in self.closures
        )
        if first is None or not at_one_place or first.at == self.point:
            return self.point
        return Point(first.at.frame, *first.at.coordinates, name=self.name)

    @property
    def ends(self) -> tuple[tuple[str, Frame], tuple[str, Frame]]:
        """The name of the parent and that of the child, empty for a frame, each with the frame of the joint on it."""
        parent, child = (
            part.name if isinstance(part, Link) else "" for part in (self.joint.parent, self.joint.child)
        )
        return (parent, self.parent_side), (child, self.child_side)

    @property
    def active(self) -> tuple[Closure, ...]:
        """The conditions that make constraints."""
        return tuple(closure for closure in self.closures if closure.name in self.constraining)

    @property
    def senses(self) -> Mapping[str, Expr]:
        """The cosines of angles between axes that its conditions allow to be opposite; empty where it places a link."""
        return {} if self.opens else self.joint.pair.senses(self.sides)

    @property
    def sheet(self) -> DataSheet:
        """The data sheet, with the constraints and the forces that the joint can exert on the child."""
        (parent, one), (child, other) = self.ends
        rows = [
            Row("parent", parent or self.joint.parent),
            Row("axes on the parent", one),
            Row("child", child or self.joint.child),
            Row("axes on the child", other),
            *self.joint.coordinate_rows(self.coordinates),
            *(row for limit in self.limits for row in limit.rows),
            *(Row(size.name, size.value) for size in self.joint.pair.sizes),
            *(Row(f"constraint {self.name}.{each.name}", each.condition, "= 0") for each in self.active),
            *(each.reaction_row for each in (self.closures if self.opens else self.active)),
            *self._point_rows,
        ]
        return DataSheet(f"{self}, which {'opens the tree' if self.opens else 'closes a loop'}", tuple(rows))

    @property
    def _point_rows(self) -> list[Row]:
        """The row about the point where teeth or wheels touch, if it is short."""
        if not self.joint.pair.coupled and not self.joint.pair.rolls:
            return []
        point = self.acting_point
        is_short = cost(list(point.coordinates)).total <= LONGEST
        return [Row("force at", point.coordinates, axes=point.frame)] if is_short else []

    @property
    def line(self) -> str:
        """The line about the joint that `show` prints for a mechanism: the parts, the coordinates or the conditions."""
        parent, child = self.joint.parent, self.joint.child
        text = f"{self.joint}: {brief(parent)} -> {brief(child)}"
        if self.opens and self.coordinates:
            text += f", by {', '.join(map(str, self.coordinates))}"
        if self.active:
            text += f"{' and' if self.opens else ' closes a loop by'} {self._named(self.active)}"
        idle = [closure for closure in self.closures if closure.name not in self.constraining]
        if not self.opens and idle:
            text += f"{';' if self.active else ' closes a loop:'} by themselves hold {self._named(idle)}"
        return text

    def _named(self, closures: Sequence[Closure]) -> str:
        return ", ".join(f"{self.name}.{closure.name}{self._within(closure)}" for closure in closures)

    def _within(self, closure: Closure) -> str:
        size = self.residuals.get(closure.name)
        return "" if size is None else f" (within {size:.2g})"

    def __repr__(self) -> str:
        return str(self.joint)


def _parts(placed: PlacedJoint) -> tuple[Any, ...]:
    return placed.parent_side, placed.child_side, placed.coordinates, placed.closures, placed.limits


def _rebuilt(placed: PlacedJoint, parts: Sequence[Any]) -> PlacedJoint:
    parent, child, coordinates, closures, limits = parts
    return replace(
        placed,
        parent_side=parent,
        child_side=child,
        coordinates=tuple(coordinates),
        closures=tuple(closures),
        limits=tuple(limits),
    )


contains(
    PlacedJoint, Container(_parts, _rebuilt, advice="its coordinates have one: diff(joint.coordinates, x)")
)
