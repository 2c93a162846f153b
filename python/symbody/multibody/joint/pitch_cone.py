"""Pitch cones of bevel gears, which roll on each other about the point in which their axes meet."""

from __future__ import annotations

from typing import NamedTuple

from symbody.geometry import Point, Vector, cross, dot
from symbody.symbolic import Expr, sqrt

__all__ = ["PitchCones"]


class PitchCones(NamedTuple):
    """Two pitch cones, whose axes z1 and z2 point from their apex to the wheels.

    Attributes:
        first: z1.
        second: z2, with components in the same frame.
        between: from a point of the first axis to a point of the second one.
    """

    first: Vector
    second: Vector
    between: Vector

    @property
    def normal(self) -> Vector:
        """``z1 x z2``; its length is the sine of the angle of the axes."""
        return cross(self.first, self.second)

    @property
    def gap(self) -> Expr:
        """The distance of the axes times the sine of their angle, with a sign; zero if they meet."""
        return dot(self.between, self.normal)

    @property
    def to_apex(self) -> tuple[Expr, Expr]:
        """How far the apex is along the axes from the points that are given on them."""
        normal = self.normal
        size = dot(normal, normal)
        along = (dot(cross(self.between, axis), normal) / size for axis in (self.second, self.first))
        one, other = along
        return one, other

    def contact(self, on_first: Point, r1: Expr, r2: Expr) -> Point:
        """Return the point at the distance r1 from the first axis and r2 from the second: ``(r2 z1 + r1 z2)/sin``.

        Args:
            on_first: the point that is given on the first axis.
            r1: the radius of the first pitch circle.
            r2: that of the second one.
        """
        size = sqrt(dot(self.normal, self.normal))
        return on_first + self.to_apex[0] * self.first + (r2 / size) * self.first + (r1 / size) * self.second

    @property
    def tangent(self) -> Vector:
        """The direction in which the first wheel moves at the contact, and the second one against it."""
        return self.normal / sqrt(dot(self.normal, self.normal))
