"""Points: coordinates in a frame."""

from __future__ import annotations

from typing import final, overload

from symbody.errors import FrameError
from symbody.geometry.component.triple import NULL, Scalar, Triple, triple
from symbody.geometry.frame.coordinates import Ends, point_coordinates
from symbody.geometry.frame.frame import Frame
from symbody.geometry.given.argument import checked
from symbody.geometry.motion.frame_motion import Substitution
from symbody.symbolic import add3, latex
from symbody.symbolic.expression.container import Container, contains
from symbody.symbolic.expression.latex_layout import bmatrix, displayed
from symbody.symbolic.given.arguments import brief

from .vector import Vector


@final
class Point:
    """A point given by its coordinates in a frame.

    Args:
        frame: in whose axes, and from whose origin, the coordinates are.
        x: the coordinate along the x axis of the frame.
        y: along y.
        z: along z.
        name: what the point is called where it is shown.

    >>> from symbody import ground, translate
    >>> A, B = Point(ground, 1, 0, 0), Point(translate(0, 2, 0), 1, 1, 0)
    >>> (B - A).components
    (0, 3, 0)
    """

    __slots__ = ("coordinates", "frame", "name")

    @checked(FrameError)
    def __init__(self, frame: Frame, x: Scalar, y: Scalar, z: Scalar, *, name: str = "") -> None:
        self.frame = frame
        self.coordinates: Triple = triple(x, y, z)
        self.name = name

    @checked(FrameError)
    def projected(self, frame: Frame) -> Point:
        """Return the same point, by its coordinates in another frame."""
        if frame == self.frame:
            return self
        return Point(frame, *point_coordinates(self.coordinates, self.frame, frame), name=self.name)

    def subs(self, substitution: Substitution) -> Point:
        """Return the point with expressions substituted."""
        x, y, z = (coordinate.subs(substitution) for coordinate in self.coordinates)
        return Point(self.frame.subs(substitution), x, y, z, name=self.name)

    def __add__(self, displacement: Vector) -> Point:
        if not isinstance(displacement, Vector):
            return NotImplemented
        moved = add3(self.coordinates, displacement.projected(self.frame).components)
        return Point(self.frame, *moved)

    __radd__ = __add__

    @overload
    def __sub__(self, other: Point) -> Vector: ...
    @overload
    def __sub__(self, other: Vector) -> Point: ...
    def __sub__(self, other: Point | Vector) -> Vector | Point:
        """Return the vector from the other point to this one, in the frame of the other; or a displaced point."""
        if isinstance(other, Vector):
            return self + -other
        if not isinstance(other, Point):
            return NotImplemented
        ends = Ends(self.coordinates, self.frame, other.coordinates, other.frame)
        return Vector.between(ends, other.frame)

    def __repr__(self) -> str:
        return self.name or f"Point({self.frame}, {', '.join(map(str, self.coordinates))})"

    def _repr_latex_(self) -> str:
        note = f"from the origin of {brief(self.frame)}, in its axes"
        return displayed(latex(self), name=self.name, note=note)


contains(
    Point,
    Container(
        parts=lambda point: (point.frame, *point.coordinates),
        rebuilt=lambda point, parts: Point(*parts, name=point.name),
        layout=lambda _, texts: bmatrix(texts, 1),
        shown=lambda point: point.coordinates,
        differentiated=lambda point: point.coordinates,
        derivative=lambda point, components: Vector(point.frame, *components),
    ),
)


@checked(FrameError)
def origin(frame: Frame) -> Point:
    """Return the origin of a frame.

    >>> from symbody import origin, symbols, translate
    >>> (origin(translate(0, 0, symbols("h"))) - origin(translate(0, 0, 0))).components
    (0, 0, h)
    """
    return Point(frame, *NULL)
