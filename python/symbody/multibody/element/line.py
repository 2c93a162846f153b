"""The line between two points: its length and its rate."""

from __future__ import annotations

from typing import NamedTuple

from symbody.errors import LoadError
from symbody.geometry import Point, Vector
from symbody.geometry.component.triple import rates
from symbody.geometry.motion.floating import rate_by
from symbody.symbolic import ENERGY, Expr, derivation, dot3, sqrt
from symbody.symbolic.given.arguments import brief

from .element import Undefined

_NO_DIRECTION = (
    "has the length zero there, so that its line has no direction; keep its ends apart, or replace it: a spring of "
    "free length zero without damping, or a bushing, is safe there"
)


class Line(NamedTuple):
    """The vector from one point to another.

    Attributes:
        vector: the vector.
        square: the square of its length l.
        half_rate: ``l l'``, the scalar product of the vector and its rate.
    """

    vector: Vector
    square: Expr
    half_rate: Expr

    @property
    def length(self) -> Expr:
        """The length l."""
        return sqrt(self.square)

    @property
    def stays_on_axis(self) -> bool:
        """Whether the vector has one component alone, whose rate is l' or -l'."""
        return sum(not each.is_zero for each in self.vector.components) == 1

    @property
    def undefined(self) -> Undefined:
        """Where a force along the line has no direction."""
        return Undefined(self.length, _NO_DIRECTION)

    @property
    def rate(self) -> Expr:
        """The rate l'."""
        return self.half_rate / self.length


def line_between(at: Point, to: Point, where: str) -> Line:
    """Return the line from a point to another.

    Raises:
        LoadError: the points are one, so that the line has no direction.
    """
    with derivation(order=ENERGY):
        vector = to - at
        rate = rate_by({**at.frame.coordinate_rates, **to.frame.coordinate_rates})
        square = dot3(vector.components, vector.components)
        if square.is_zero:
            raise LoadError(
                f"{where}: {brief(at)} and {brief(to)} are the same place at every position, so that the line between "
                "them has no direction; give two points that move apart, or use a bushing"
            )
        return Line(vector, square, dot3(vector.components, rates(vector.components, rate)))
