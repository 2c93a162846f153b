"""Rigid bodies."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Annotated, TypeAlias, final

from symbody.deferred import cached_property
from symbody.errors import BodyError
from symbody.geometry import Frame, Point, Scalar, Triple, origin
from symbody.geometry.component.triple import expression, triple
from symbody.geometry.given.argument import checked
from symbody.geometry.motion.translation import Translation
from symbody.symbolic import Expr, Matrix, latex, matvec3
from symbody.symbolic.expression.container import Container, contains
from symbody.symbolic.expression.latex_layout import aligned, displayed
from symbody.symbolic.given.arguments import brief

from .inertia_matrix import Tensor, central_inertia
from .physical_inertia import report_impossible_inertia

Place: TypeAlias = Annotated[
    Point | Frame, "the centre of mass: a point, such as Point(frame, x, y, z), or a frame whose origin it is"
]


def varying_inertia(values: Sequence[Expr]) -> str | None:
    """Return what is wrong with a mass or an inertia that changes: the momentum that it takes along is unknown.

    Args:
        values: the mass, the three moments and the three products of inertia.
    """
    names = ("mass", "Ix", "Iy", "Iz", "Cyz", "Cxz", "Cxy")
    for name, value in zip(names, values, strict=True):
        if value.depends_on_time:
            return (
                f"{name} = {brief(value)} depends on time; expected a constant, such as symbols('m'): bodies are rigid "
                "and neither gain nor lose mass; make several bodies of parts that move relative to each other"
            )
    return None


@final
class Body:
    """A rigid body: a frame at its centre of mass, a mass, and the inertia about the centre of mass in that frame.

    The tensor of inertia is ``[[Ix, -Cxy, -Cxz], [-Cxy, Iy, -Cyz], [-Cxz, -Cyz, Iz]]``: products of inertia have a
    minus sign. Masses and inertias may be zero. They may be negative where a body is subtracted from another one. Two
    bodies are never equal, even if all their values are.

    There is a notice for values that no rigid body can have, such as the moments 1, 1 and 5. A single moment gives no
    notice, since a planar motion needs no other. The `System` checks negative ones together with the bodies from which
    they are taken.

    Args:
        place: the centre of mass, or a frame at the centre of mass in whose axes the inertia is given.
        mass: the mass; a constant, as all that follow.
        Ix: the moment of inertia about the x axis through the centre of mass.
        Iy: about y.
        Iz: about z.
        Cyz: the product of inertia, the integral of ``y z dm``.
        Cxz: that of ``x z dm``.
        Cxy: that of ``x y dm``.
        name: what the body is called where it is shown.

    >>> from symbody import Point, ground, symbols
    >>> Body(Point(ground, 1, 0, 0), symbols("m")).mass
    m
    """

    has_partial_inertia: bool = False
    """Whether moments of inertia of its parts were left out, as those of plane bodies that are joined."""

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
        self._set(place, (mass, Ix, Iy, Iz, Cyz, Cxz, Cxy), name)
        report_impossible_inertia(self)

    def _set(self, place: Place, values: Sequence[Scalar], name: str) -> None:
        self.frame = place.frame.then(Translation(place.coordinates)) if isinstance(place, Point) else place
        self.mass = expression(values[0])
        self.moments, self.products = triple(*values[1:4]), triple(*values[4:])
        self.name = name
        if (fault := varying_inertia((self.mass, *self.moments, *self.products))) is not None:
            raise BodyError(f"Body{f' {name}' if name else ''}: {fault}")

    @classmethod
    def of_partial_inertia(cls, place: Place, values: Sequence[Scalar], name: str) -> Body:
        """Return a body some of whose moments of inertia are left out, so that no notice finds it impossible.

        Args:
            place: the centre of mass, or a frame at the centre of mass.
            values: the mass, the three moments and the three products of inertia.
            name: what the body is called where it is shown.

        >>> from symbody import ground
        >>> Body.of_partial_inertia(ground, (2, 0, 0.5, 2.5, 0, 0, 0), "plates").moments
        (0, 0.5, 2.5)
        """
        body = cls.__new__(cls)
        cls._set(body, place, values, name)
        body.has_partial_inertia = True
        return body

    def with_values(self, place: Place, *values: Scalar) -> Body:
        """Return the same body at another place, or with other values.

        Args:
            place: the centre of mass, or a frame at the centre of mass.
            values: the mass, the three moments and the three products of inertia.

        >>> from symbody import ground
        >>> Body(ground, 1, name="disc").with_values(ground, 2, 1, 1, 2, 0, 0, 0).moments
        (1, 1, 2)
        """
        if self.has_partial_inertia:
            return Body.of_partial_inertia(place, values, self.name)
        return Body(place, *values, name=self.name)

    @classmethod
    @checked(BodyError)
    def of_inertia(
        cls, place: Place, mass: Scalar, inertia: Tensor, *, about: Point | None = None, name: str = ""
    ) -> Body:
        """Return the body with a tensor of inertia that is given as a matrix, as computer-aided design prints it.

        Args:
            place: the centre of mass, or a frame at the centre of mass in whose axes the tensor is given.
            mass: the mass.
            inertia: the tensor ``[[Ix, -Cxy, -Cxz], [-Cxy, Iy, -Cyz], [-Cxz, -Cyz, Iz]]``, symmetric.
            about: the point about which the tensor is, fixed in the body; the centre of mass by default.
            name: what the body is called where it is shown.

        >>> from symbody import Matrix, Point, ground, symbols
        >>> m, l, J = symbols("m l J")
        >>> J_end, end = Matrix([[0, 0, 0], [0, J, 0], [0, 0, J]]), Point(ground, 0, 0, 0)
        >>> Body.of_inertia(Point(ground, l, 0, 0), m, J_end, about=end).moments
        (0, J - m*l**2, J - m*l**2)
        """
        arm = None
        if about is not None:
            center = place if isinstance(place, Point) else origin(place)
            arm = (center - about.projected(center.frame)).components
        entries = central_inertia(inertia, mass, arm, "Body.of_inertia", BodyError)
        return cls(place, mass, *entries, name=name)

    @property
    def inertia(self) -> Matrix:
        """The tensor of inertia about the centre of mass."""
        r = self.inertia_entries
        return Matrix([r[:3], r[3:6], r[6:]])

    @cached_property
    def inertia_entries(self) -> tuple[Expr, ...]:
        """The nine entries of the tensor of inertia, row by row."""
        (xx, yy, zz), (yz, xz, xy) = self.moments, self.products
        return xx, -xy, -xz, -xy, yy, -yz, -xz, -yz, zz

    @cached_property
    def is_particle(self) -> bool:
        """Whether the body has no inertia but its mass."""
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
        """The sort key of the bodies of a set."""
        values = (self.mass, *self.moments, *self.products)
        return b"".join((self.name.encode(), self.frame.key, *(value.fingerprint for value in values)))

    def _repr_latex_(self) -> str:
        return displayed(latex(self))

    def __repr__(self) -> str:
        return self.name or f"Body({self.frame}, {self.mass})"


def _layout(body: Body, texts: list[str]) -> str:
    frame, mass, inertia = texts
    del body
    return aligned(
        [rf"\text{{frame}} &: {frame}", rf"\text{{mass}} &: {mass}", rf"\text{{inertia}} &: {inertia}"]
    )


contains(
    Body,
    Container(
        parts=lambda body: (body.frame, body.mass, *body.moments, *body.products),
        rebuilt=lambda body, parts: body.with_values(*parts),
        layout=_layout,
        shown=lambda body: (body.frame, body.mass, body.inertia),
        advice="its mass, inertia and frame.matrix have one",
    ),
)


@checked(BodyError)
def center_of_mass(body: Body) -> Point:
    """Return the centre of mass of a body.

    >>> from symbody import Body, Point, center_of_mass, ground
    >>> center_of_mass(Body(Point(ground, 1, 2, 0), 1)).coordinates
    (0, 0, 0)
    >>> center_of_mass(Body(Point(ground, 1, 2, 0), 1)).projected(ground).coordinates
    (1, 2, 0)
    """
    return body.center_of_mass
