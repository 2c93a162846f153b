"""Rigid bodies."""

from __future__ import annotations

from functools import cached_property
from typing import Annotated, TypeAlias, final

from symbody.errors import BodyError
from symbody.geometry import Frame, Point, Scalar, Triple, origin
from symbody.geometry.argument import checked
from symbody.geometry.translation import Translation
from symbody.geometry.triple import expression, triple
from symbody.symbolic import Expr, Matrix, matvec3
from symbody.symbolic.given.arguments import brief

from .physical_inertia import report_impossible_inertia

Place: TypeAlias = Annotated[
    Point | Frame, "the centre of mass: a point, such as Point(frame, x, y, z), or a frame whose origin it is"
]


@final
class Body:
    """A rigid body: a frame at its centre of mass, a mass, and the inertia about the centre of mass in that frame.

    The products of inertia have a minus sign off the diagonal: ``[[Ix, -Cxy, -Cxz], [-Cxy, Iy, -Cyz],
    [-Cxz, -Cyz, Iz]]``. Masses and inertias may be zero, or negative: what is subtracted from another body. Two bodies
    are never equal, even if all their values are.

    Numbers that no body has, such as the moments 1, 1 and 5, have a notice. One moment alone has none: a motion in a
    plane needs no other. Negative ones are checked with the bodies from which they are taken, by the `System`.

    >>> from symbody import Point, ground, symbols
    >>> Body(Point(ground, 1, 0, 0), symbols("m")).mass
    m
    """

    @checked(BodyError)
    def __init__(
        self,
        place: Place,
        mass: Scalar,
        Ix: Scalar = 0,
        Iy: Scalar = 0,
        Iz: Scalar = 0,
        Cyz: Scalar = 0,
        Cxz: Scalar = 0,
        Cxy: Scalar = 0,
        *,
        name: str = "",
    ) -> None:
        self.frame = place.frame.then(Translation(place.coordinates)) if isinstance(place, Point) else place
        self.mass = expression(mass)
        self.moments = triple(Ix, Iy, Iz)
        self.products = triple(Cyz, Cxz, Cxy)
        self.name = name
        self._check_constant()
        report_impossible_inertia(self)

    def _check_constant(self) -> None:
        """A mass that changes would take momentum with it, and no equation here knows where to."""
        names = ("mass", "Ix", "Iy", "Iz", "Cyz", "Cxz", "Cxy")
        for name, value in zip(names, (self.mass, *self.moments, *self.products), strict=True):
            if value.depends_on_time:
                raise BodyError(
                    f"Body: {name} = {brief(value)} depends on time; expected a constant, such as symbols('m'): "
                    "bodies are rigid and neither gain nor lose mass; make several bodies of parts that move in each "
                    "other"
                )

    @property
    def inertia(self) -> Matrix:
        """The tensor of inertia about the centre of mass."""
        r = self.inertia_entries
        return Matrix([r[:3], r[3:6], r[6:]])

    @cached_property
    def inertia_entries(self) -> tuple[Expr, ...]:
        """The nine entries of the tensor of inertia, row after row."""
        (xx, yy, zz), (yz, xz, xy) = self.moments, self.products
        return xx, -xy, -xz, -xy, yy, -yz, -xz, -yz, zz

    @cached_property
    def is_particle(self) -> bool:
        """Whether there is no inertia but the mass."""
        return not self.has_products and all(entry.is_zero for entry in self.moments)

    @cached_property
    def has_products(self) -> bool:
        """Whether the axes of the frame aren't the principal axes of inertia."""
        return not all(entry.is_zero for entry in self.products)

    @property
    def center_of_mass(self) -> Point:
        """The centre of mass."""
        return origin(self.frame)

    def spin_momentum(self, angular_velocity: Triple) -> Triple:
        """Return the angular momentum about the centre of mass, in the body's axes."""
        return matvec3(self.inertia_entries, angular_velocity)

    @property
    def key(self) -> bytes:
        """What puts the bodies of a set in order."""
        values = (self.mass, *self.moments, *self.products)
        return b"".join((self.name.encode(), self.frame.key, *(value.fingerprint for value in values)))

    def __repr__(self) -> str:
        return self.name or f"Body({self.frame}, {self.mass})"


@checked(BodyError)
def center_of_mass(body: Body) -> Point:
    """Return the centre of mass of a body."""
    return body.center_of_mass
