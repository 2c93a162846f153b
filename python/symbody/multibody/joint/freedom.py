"""Freedoms of joints: the ways in which they let the child move, along which motors, friction and springs act."""

from __future__ import annotations

from dataclasses import dataclass
from typing import final

from symbody.geometry import Frame, Point, angular_velocity, dot, frozen_velocity
from symbody.geometry.motion.floating import rate_by
from symbody.multibody.data_sheet import DataSheet, Row, WithSheet
from symbody.symbolic import Expr, atan2, cos, sin

from .pair import Travel

__all__ = ["Freedom"]


@final
@dataclass(frozen=True, eq=False)
class Freedom(WithSheet):
    """One way in which a joint lets its child move: ``mechanism.joint("C").freedom("phi")``.

    Attributes:
        joint: the joint, such as "revolute C".
        name: of the coordinate, such as "phi".
        value: the coordinate; where the joint closes a loop, what it would be. An angle then counts from -pi to pi,
            unless its axis has a constant direction in both bodies at every position, as in a plane mechanism: there
            it is a sum of coordinates, over any number of turns. ``motion[freedom]`` has all turns in any case.
        ends: the names of the parent and of the child, empty for a frame.
        sides: the axes of the joint on both.
        travel: how the child moves along it; None where the coordinate alone determines it.
        is_coordinate: whether the value is a coordinate, as in the tree, or along a curve.

    >>> from symbody import Link, assemble, ground, prismatic, revolute, symbols
    >>> r, l = symbols("r l")
    >>> crank, rod, slider = (Link(name, 1) for name in ("crank", "rod", "slider"))
    >>> A, B = revolute("A", ground, crank), revolute("B", crank, rod, at=(r, 0, 0))
    >>> C, D = revolute("C", rod, slider, at=(l, 0, 0)), prismatic("D", ground, slider)
    >>> assemble([A, B, C, D]).joint(C).freedom().value
    phi_C
    """

    joint: str
    name: str
    value: Expr
    ends: tuple[str, str]
    sides: tuple[Frame, Frame]
    travel: Travel | None = None
    is_coordinate: bool = False

    @property
    def point(self) -> Point:
        """The point of the child at the joint."""
        return Point(self.sides[1], 0, 0, 0)

    @property
    def rate(self) -> Expr:
        """The rate of the value, by the velocity of the child along the axis: it has no jumps where an angle has."""
        parent, child = self.sides
        if self.is_coordinate or self.travel is None:
            (rate,) = rate_by({**child.coordinate_rates, **parent.coordinate_rates})((self.value,))
            return rate
        if self.travel.is_rotation:
            return dot(self.travel.axis, angular_velocity(child).projected(parent) - angular_velocity(parent))
        return dot(self.travel.axis, frozen_velocity(self.point, child) - frozen_velocity(self.point, parent))

    @property
    def jumps(self) -> bool:
        """Whether the value is an angle that is known from -pi to pi alone."""
        return self.travel is not None and self.travel.jumps

    def beyond(self, start: Expr) -> Expr:
        """Return the value beyond another one; of an angle that jumps, from -pi to pi."""
        beyond = self.value - start
        return atan2(sin(beyond), cos(beyond)) if self.jumps and not start.is_zero else beyond

    @property
    def sheet(self) -> DataSheet:
        """The data sheet."""
        return DataSheet(f"freedom {self}", (Row("value", self.value), Row("rate", self.rate)))

    def __repr__(self) -> str:
        return f"Freedom({self})"

    def __str__(self) -> str:
        return f"{self.name} of {self.joint}"
