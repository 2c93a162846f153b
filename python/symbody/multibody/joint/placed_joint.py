"""Joints where they are placed: frames on both sides, and what they hold."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any, final

from symbody.geometry import Frame, Point
from symbody.symbolic import Expr
from symbody.symbolic.expression.container import Container, contains
from symbody.symbolic.given.arguments import brief

from .closure import Closure, Sides, names_that_constrain
from .joint import Joint
from .link import Link

__all__ = ["PlacedJoint"]


@final
@dataclass(frozen=True, eq=False)
class PlacedJoint:
    """A joint of a mechanism, with the frames on which it is.

    Attributes:
        joint: the joint as it was given.
        parent_side: its axes P on the parent.
        child_side: its axes C on the child.
        coordinates: those that place a link; empty where it closes a loop.
        closures: what it holds, and by which forces.
        constraining: the names of the closures that make constraints: those that don't hold by themselves.
        outboard: the names of the links beyond it, where it opens the tree; None where it closes a loop.
        limits: the least and the largest value of its coordinate.
        measured: the value of its coordinate, if it has one.
    """

    joint: Joint
    parent_side: Frame
    child_side: Frame
    coordinates: tuple[Expr, ...]
    closures: tuple[Closure, ...]
    constraining: tuple[str, ...]
    outboard: tuple[str, ...] | None
    limits: tuple[Expr | None, Expr | None] = (None, None)
    measured: Expr | None = None

    @classmethod
    def of(cls, joint: Joint, sides: Sides, outboard: tuple[str, ...] | None) -> PlacedJoint:
        """Return a joint between frames; one that opens the tree leads to links."""
        opens = outboard is not None
        closures = joint.pair.opened(sides, joint.coordinates) if opens else joint.pair.closures(sides)
        return cls(
            joint,
            sides.parent,
            sides.child,
            joint.coordinates if opens else joint.pair.keeps,
            closures,
            () if opens and not joint.pair.rolls else names_that_constrain(closures),
            outboard,
            joint.limits,
            _measured(joint, sides, opens=opens),
        )

    @property
    def name(self) -> str:
        """The name of the joint."""
        return self.joint.name

    @property
    def opens(self) -> bool:
        """Whether it opens the tree; else it closes a loop."""
        return self.outboard is not None

    @property
    def point(self) -> Point:
        """The point of the child at the joint, about which moments of reactions are given."""
        return Point(self.child_side, 0, 0, 0, name=self.name)

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

    def description(self) -> str:
        """Return one line: what it joins, its coordinates or its conditions."""
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
        return ", ".join(f"{self.name}.{closure.name}" for closure in closures)

    def __repr__(self) -> str:
        return str(self.joint)


def _measured(joint: Joint, sides: Sides, *, opens: bool) -> Expr | None:
    if opens and len(joint.coordinates) == 1:
        return joint.coordinates[0]
    return joint.pair.measured(sides)


def _parts(placed: PlacedJoint) -> tuple[Any, ...]:
    given = [value for value in (*placed.limits, placed.measured) if value is not None]
    return placed.parent_side, placed.child_side, placed.coordinates, placed.closures, given


def _rebuilt(placed: PlacedJoint, parts: Sequence[Any]) -> PlacedJoint:
    parent, child, coordinates, closures, given = parts
    values = iter(given)
    low, high, measured = (None if old is None else next(values) for old in (*placed.limits, placed.measured))
    return replace(
        placed,
        parent_side=parent,
        child_side=child,
        coordinates=tuple(coordinates),
        closures=tuple(closures),
        limits=(low, high),
        measured=measured,
    )


contains(
    PlacedJoint, Container(_parts, _rebuilt, advice="its coordinates have one: diff(joint.coordinates, x)")
)
