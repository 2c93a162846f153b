"""Shapes of bodies, given by the user."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, final

from symbody.geometry import Frame, Scalar
from symbody.geometry.component.triple import expression
from symbody.symbolic import Expr

Place = tuple[Scalar, Scalar, Scalar]
CENTRE: Place = (0, 0, 0)


class Shape(ABC):
    """A solid, fixed in the frame of the body at its centre of mass, or in another frame.

    >>> isinstance(Box(2, 1, 1), Shape)
    True
    """

    frame: Frame | None
    """The frame of its coordinates; None stands for that of the body."""

    @property
    @abstractmethod
    def lengths(self) -> tuple[Expr, ...]:
        """All lengths of the shape, expressions of the parameters."""

    @abstractmethod
    def part(self, lengths: Sequence[float]) -> dict[str, Any]:
        """Return the entry of the page for given values of the lengths."""


@final
@dataclass(frozen=True)
class Box(Shape):
    """A box, given by its sides along x, y and z, and its centre.

    >>> from symbody import symbols
    >>> Box(symbols("l"), 0.1, 0.1).part([2, 0.1, 0.1, 0, 0, 0])
    {'kind': 'box', 'size': [2, 0.1, 0.1], 'at': [0, 0, 0]}
    """

    x: Scalar
    y: Scalar
    z: Scalar
    at: Place = CENTRE
    frame: Frame | None = None

    @property
    def lengths(self) -> tuple[Expr, ...]:
        return tuple(map(expression, (self.x, self.y, self.z, *self.at)))

    def part(self, lengths: Sequence[float]) -> dict[str, Any]:
        return {"kind": "box", "size": list(lengths[:3]), "at": list(lengths[3:])}


@final
@dataclass(frozen=True)
class Ellipsoid(Shape):
    """An ellipsoid, given by its semi-axes along x, y and z, and its centre.

    >>> Ellipsoid(2, 1, 1).part([2, 1, 1, 0, 0, 0])["kind"]
    'ellipsoid'
    """

    x: Scalar
    y: Scalar
    z: Scalar
    at: Place = CENTRE
    frame: Frame | None = None

    @property
    def lengths(self) -> tuple[Expr, ...]:
        return tuple(map(expression, (self.x, self.y, self.z, *self.at)))

    def part(self, lengths: Sequence[float]) -> dict[str, Any]:
        return {"kind": "ellipsoid", "size": list(lengths[:3]), "at": list(lengths[3:])}


@final
@dataclass(frozen=True)
class Cylinder(Shape):
    """A cylinder, given by its radius and the centres of its ends: a wheel, a rod, a rope drum.

    >>> Cylinder(0.3, (0, -0.1, 0), (0, 0.1, 0)).part([0.3, 0, -0.1, 0, 0, 0.1, 0])["radius"]
    0.3
    """

    radius: Scalar
    start: Place
    end: Place
    frame: Frame | None = None

    @property
    def lengths(self) -> tuple[Expr, ...]:
        return tuple(map(expression, (self.radius, *self.start, *self.end)))

    def part(self, lengths: Sequence[float]) -> dict[str, Any]:
        radius, *ends = lengths
        return {"kind": "rod", "radius": radius, "from": ends[:3], "to": ends[3:]}


@final
@dataclass(frozen=True)
class Plate(Shape):
    """A plate parallel to the x-y plane, given by its corners in order, its thickness, and its middle plane's z.

    >>> len(Plate(((0, 0), (1, 0), (0, 1)), 0.1).lengths)
    8
    """

    corners: tuple[tuple[Scalar, Scalar], ...]
    thickness: Scalar
    z: Scalar = 0
    frame: Frame | None = None

    @property
    def lengths(self) -> tuple[Expr, ...]:
        flat = (coordinate for corner in self.corners for coordinate in corner)
        return tuple(map(expression, (self.thickness, self.z, *flat)))

    def part(self, lengths: Sequence[float]) -> dict[str, Any]:
        thickness, z, *flat = lengths
        corners = [list(pair) for pair in zip(flat[::2], flat[1::2], strict=True)]
        return {"kind": "plate", "corners": corners, "thickness": thickness, "z": z}
