"""Free vectors: components in a frame."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Annotated, Any, TypeAlias, final

from symbody.errors import FrameError
from symbody.geometry.component.triple import Scalar, Triple, expression, triple
from symbody.geometry.frame.coordinates import Ends, difference, vector_components
from symbody.geometry.frame.frame import Frame
from symbody.geometry.given.argument import checked
from symbody.geometry.motion.frame_motion import Substitution
from symbody.symbolic import Expr, add3, cross3, dot3, latex, number, scale3, sub3
from symbody.symbolic.expression.container import Container, contains
from symbody.symbolic.expression.latex_layout import bmatrix, displayed
from symbody.symbolic.given.arguments import brief

Factor: TypeAlias = Annotated[Scalar, "an expression or a number; two vectors multiply by dot and cross"]


@final
class Vector:
    """A free vector: moving its frame's origin doesn't change it.

    Sums and products of vectors in different frames have the frame of the first vector.

    Args:
        frame: in whose axes the components are.
        x: the component along the x axis of the frame.
        y: along y.
        z: along z.
        name: what the vector is called where it is shown.

    >>> from symbody import ground, pi, rotate
    >>> Vector(ground, 1, 0, 0) + Vector(rotate("Z", pi / 2), 1, 0, 0)
    Vector(ground, 1, 1, 0)
    """

    __slots__ = ("_ends", "components", "frame", "name")

    _ends: Ends | None
    """The points between which it goes, if it was made so: other frames see them, not these components."""

    @checked(FrameError)
    def __init__(self, frame: Frame, x: Scalar, y: Scalar, z: Scalar, *, name: str = "") -> None:
        self.frame = frame
        self.components: Triple = triple(x, y, z)
        self.name = name
        self._ends = None

    @classmethod
    def between(cls, ends: Ends, frame: Frame, *, name: str = "") -> Vector:
        """Return the vector between two points, by its components in a frame."""
        vector = cls(frame, *difference(ends, frame), name=name)
        vector._ends = ends
        return vector

    @checked(FrameError)
    def projected(self, frame: Frame) -> Vector:
        """Return the same vector, by its components in another frame."""
        if frame == self.frame:
            return self
        if self._ends is not None:
            return Vector.between(self._ends, frame, name=self.name)
        return Vector(frame, *vector_components(self.components, self.frame, frame), name=self.name)

    def subs(self, substitution: Substitution) -> Vector:
        """Return the vector with expressions substituted."""
        x, y, z = (component.subs(substitution) for component in self.components)
        vector = Vector(self.frame.subs(substitution), x, y, z, name=self.name)
        vector._ends = None if self._ends is None else self._ends.subs(substitution)
        return vector

    def parts(self) -> tuple[Any, ...]:
        """Return the frame, the components, and the points between which the vector goes."""
        return self.frame, *self.components, *(self._ends or ())

    def rebuilt(self, parts: Sequence[Any]) -> Vector:
        """Return the same vector with other `parts`."""
        vector = Vector(*parts[:4], name=self.name)
        vector._ends = None if self._ends is None else Ends(*parts[4:])
        return vector

    def __add__(self, other: Vector) -> Vector:
        if not isinstance(other, Vector):
            return NotImplemented
        return Vector(self.frame, *add3(self.components, other.projected(self.frame).components))

    def __sub__(self, other: Vector) -> Vector:
        if not isinstance(other, Vector):
            return NotImplemented
        return Vector(self.frame, *sub3(self.components, other.projected(self.frame).components))

    @checked(FrameError)
    def __mul__(self, factor: Factor) -> Vector:
        return Vector(self.frame, *scale3(expression(factor), self.components))

    __rmul__ = __mul__

    @checked(FrameError)
    def __truediv__(self, divisor: Factor) -> Vector:
        return self * (number(1) / expression(divisor))

    def __neg__(self) -> Vector:
        return self * -1

    def __repr__(self) -> str:
        return self.name or f"Vector({self.frame}, {', '.join(map(str, self.components))})"

    def _repr_latex_(self) -> str:
        return displayed(latex(self), name=self.name, note=f"in the axes of {brief(self.frame)}")


contains(
    Vector,
    Container(
        parts=Vector.parts,
        rebuilt=Vector.rebuilt,
        layout=lambda _, texts: bmatrix(texts, 1),
        shown=lambda vector: vector.components,
        differentiated=lambda vector: vector.components,
        derivative=lambda vector, components: Vector(vector.frame, *components),
    ),
)


@checked(FrameError)
def dot(u: Vector, v: Vector) -> Expr:
    """Return the scalar product.

    >>> from symbody import Vector, cos, dot, functions_of_time, ground, rotate
    >>> phi = functions_of_time("phi")
    >>> dot(Vector(ground, 2, 0, 0), Vector(rotate("Z", phi), 3, 0, 0))
    6*cos(phi)
    """
    return dot3(u.components, v.projected(u.frame).components)


@checked(FrameError)
def cross(u: Vector, v: Vector) -> Vector:
    """Return the vector product, in the frame of the first vector.

    >>> from symbody import Vector, cross, ground
    >>> cross(Vector(ground, 1, 0, 0), Vector(ground, 0, 2, 0))
    Vector(ground, 0, 0, 2)
    """
    return Vector(u.frame, *cross3(u.components, v.projected(u.frame).components))
