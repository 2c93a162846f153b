"""Links: rigid bodies before they are placed."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Annotated, TypeAlias, final

from symbody.errors import JointError
from symbody.geometry import Frame, Scalar, ground, origin, translate
from symbody.geometry.component.triple import expression, triple
from symbody.geometry.given.argument import checked
from symbody.multibody.body import Body, varying_inertia
from symbody.multibody.data_sheet import DataSheet, Row, WithSheet
from symbody.multibody.inertia_matrix import Tensor, central_inertia
from symbody.symbolic import Expr
from symbody.symbolic.given.arguments import brief, counted

Place: TypeAlias = Annotated[
    Frame | Sequence[Scalar],
    "three coordinates, such as (a, 0, 0), or a frame, such as translate(a, 0, 0) * rotate('X', alpha)",
]


def fixed_place(where: str, place: Place) -> Frame:
    """Return a place in a body as a frame; raise an error if it moves there."""
    if not isinstance(place, Frame):
        if len(place) != 3:
            raise JointError(f"{where} has {counted(len(place), 'coordinate')}; expected three, or a frame")
        place = translate(*place)
    moving = next((motion for motion in place.motions if not motion.is_constant), None)
    if moving is not None:
        raise JointError(
            f"{where} = {brief(place)} moves; expected a place that is fixed in the body, in whose axes it is given"
        )
    return place


def shown_place(place: Frame) -> Frame | tuple[Expr, ...]:
    """Return the coordinates of a place in a body, or the frame if its axes are turned."""
    is_turned = any(place.matrix[i, j] != int(i == j) for i in range(3) for j in range(3))
    return place if is_turned else origin(place).projected(ground).coordinates


@final
class Link(WithSheet):
    """A rigid body of a mechanism before it is placed: its mass, centre of mass and inertia in its own axes.

    `assemble` places links by their joints and makes a `Body` of each. Two links are never equal.

    Args:
        name: what the link and its body are called; each link of a mechanism has a name of its own.
        mass: the mass.
        Ix: the moment of inertia about the x axis through the centre of mass; see `Body` for all of them.
        Iy: about y.
        Iz: about z.
        Cyz: the product of inertia, the integral of ``y z dm``.
        Cxz: that of ``x z dm``.
        Cxy: that of ``x y dm``.
        center: the centre of mass in the axes of the link, from its origin; or a frame there, in whose axes the
            inertia is given.

    >>> from symbody import Link, symbols
    >>> m, l = symbols("m l")
    >>> Link("rod", m, Iz=m * l**2 / 12, center=(l / 2, 0, 0))
    rod
    """

    @checked(JointError)
    def __init__(
        self,
        name: str,
        mass: Scalar = 0,
        Ix: Scalar = 0,
        Iy: Scalar = 0,
        Iz: Scalar = 0,
        Cyz: Scalar = 0,
        Cxz: Scalar = 0,
        Cxy: Scalar = 0,
        *,
        center: Place = (0, 0, 0),
    ) -> None:
        if not name:
            raise JointError("Link: no name; expected a text, such as 'rod', by which its body is called")
        if name == "ground":
            raise JointError("Link: the name 'ground' is that of the ground; expected another one")
        self.name = name
        self.mass = expression(mass)
        self.moments, self.products = triple(Ix, Iy, Iz), triple(Cyz, Cxz, Cxy)
        if (fault := varying_inertia((self.mass, *self.moments, *self.products))) is not None:
            raise JointError(f"Link {name}: {fault}")
        self.center = fixed_place(f"Link {name}: center", center)

    @classmethod
    @checked(JointError)
    def of_inertia(
        cls,
        name: str,
        mass: Scalar,
        inertia: Tensor,
        *,
        center: Place = (0, 0, 0),
        about: Place | None = None,
    ) -> Link:
        """Return the link with a tensor of inertia that is given as a matrix, as computer-aided design prints it.

        Args:
            name: what the link and its body are called.
            mass: the mass.
            inertia: the tensor ``[[Ix, -Cxy, -Cxz], [-Cxy, Iy, -Cyz], [-Cxz, -Cyz, Iz]]``, symmetric.
            center: the centre of mass in the axes of the link; or a frame there, in whose axes the tensor is given.
            about: the point about which the tensor is, in the axes of the link; the centre of mass by default.

        >>> from symbody import Link, Matrix, symbols
        >>> m, l, J = symbols("m l J")
        >>> J_end = Matrix([[0, 0, 0], [0, J, 0], [0, 0, J]])
        >>> Link.of_inertia("rod", m, J_end, center=(l, 0, 0), about=(0, 0, 0)).moments
        (0, J - m*l**2, J - m*l**2)
        """
        where = f"Link.of_inertia {name}"
        arm = None
        if about is not None:
            place = fixed_place(f"{where}: center", center)
            arm = (origin(place) - origin(fixed_place(f"{where}: about", about))).projected(place).components
        return cls(name, mass, *central_inertia(inertia, mass, arm, where, JointError), center=center)

    def body(self, frame: Frame) -> Body:
        """Return the body of the link, whose axes are those of a frame."""
        return Body(frame * self.center, self.mass, *self.moments, *self.products, name=self.name)

    @property
    def sheet(self) -> DataSheet:
        """The data sheet."""
        inertia = self.body(ground).inertia
        center = Row("centre of mass", shown_place(self.center))
        return DataSheet(f"link {self.name}", (center, Row("mass", self.mass), Row("inertia", inertia)))

    def __repr__(self) -> str:
        return self.name
