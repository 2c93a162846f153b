"""Several bodies that are joined rigidly as one: its mass, its centre and its inertia."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Annotated, NamedTuple, TypeAlias

from symbody.errors import BodyError
from symbody.geometry import Frame, Point, Triple
from symbody.geometry.frame.coordinates import vector_components
from symbody.geometry.given.argument import checked
from symbody.symbolic import Expr, add3, dot3, number, scale3, sub3
from symbody.symbolic.given.arguments import brief, given_twice

from .body import Body
from .constant_form import constant_form
from .physical_inertia import is_planar

Several: TypeAlias = Annotated[Sequence[Body], "a list of bodies, such as [wheel, tyre]"]


@checked(BodyError)
def combined(bodies: Several, *, frame: Frame | None = None, name: str = "") -> Body:
    """Return the body that several bodies make together, if they are joined rigidly.

    With ``m = sum(m_k)`` and the centre ``c = sum(m_k c_k)/m``, the tensor of inertia about c is
    ``sum(R_k J_k R_k^T + m_k (d^2 1 - d d^T))`` with ``d = c_k - c`` [Huygens, Steiner]. Bodies of negative mass are
    taken away. Rotors without mass add their inertias alone, at the place of the first. Of plane bodies, which have one
    moment of inertia, only the one about that axis is complete.

    Args:
        bodies: the bodies.
        frame: the frame in whose axes the inertia is; that of the first body by default.
        name: what the body is called.

    >>> from symbody import Point, combined, ground, symbols
    >>> m, l = symbols("m l")
    >>> dumbbell = combined([Body(Point(ground, -l, 0, 0), m), Body(Point(ground, l, 0, 0), m)], frame=ground)
    >>> dumbbell.mass, dumbbell.moments
    (2*m, (0, 2*m*l**2, 2*m*l**2))
    """
    if not bodies:
        raise BodyError("combined: no bodies; give at least one")
    if (twice := given_twice(bodies)) is not None:
        raise BodyError(f"combined: the body {brief(twice)} is given twice; give it once")
    axes = bodies[0].frame if frame is None else frame
    mass = sum((body.mass for body in bodies), start=number(0))
    placed = [_Placed.of(body, axes) for body in bodies]
    center = _center(bodies, placed, mass)
    total = [number(0)] * 9
    for each in placed:
        about = steiner(each.mass, sub3(each.place, center))
        total = [a + b + c for a, b, c in zip(total, each.tensor, about, strict=True)]
    xx, xy, xz, _, yy, yz, _, _, zz = total
    place, values = Point(axes, *center), (mass, xx, yy, zz, -yz, -xz, -xy)
    if any(body.has_partial_inertia or is_planar(body) for body in bodies):
        return Body.of_partial_inertia(place, values, name)
    return Body(place, *values, name=name)


def _center(bodies: Sequence[Body], placed: Sequence[_Placed], mass: Expr) -> Triple:
    """Return the centre of mass; of rotors without mass, which have none, the place of the first.

    Raises:
        BodyError: the masses add up to zero, but they are not all zero.
    """
    if all(body.mass.is_zero for body in bodies):
        return placed[0].place
    if mass.is_zero:
        raise BodyError(
            f"combined: the masses of {', '.join(map(brief, bodies))} add up to zero, so that there is no centre "
            "of mass; give bodies with mass"
        )
    moment = (number(0), number(0), number(0))
    for each in placed:
        moment = add3(moment, scale3(each.mass, each.place))
    return scale3(1 / mass, moment)


class _Placed(NamedTuple):
    """A body in the axes of another frame: its mass, its centre, and its tensor of inertia about it, row by row."""

    mass: Expr
    place: Triple
    tensor: list[Expr]

    @classmethod
    def of(cls, body: Body, axes: Frame) -> _Placed:
        zero, one = number(0), number(1)
        units = ((one, zero, zero), (zero, one, zero), (zero, zero, one))
        rows = [vector_components(unit, axes, body.frame) for unit in units]
        entries = [
            *body.center_of_mass.projected(axes).coordinates,
            *(entry for row in rows for entry in row),
        ]
        constants = [each for each in map(constant_form, entries) if each is not None]
        if len(constants) < len(entries):
            raise BodyError(
                f"combined: {brief(body)} moves relative to {brief(axes)}; expected bodies that are joined rigidly, "
                "with the same moving frame before their own"
            )
        place, *turned = [(constants[k], constants[k + 1], constants[k + 2]) for k in (0, 3, 6, 9)]
        spun = [body.spin_momentum(row) for row in turned]
        return cls(body.mass, place, [dot3(u, v) for u in turned for v in spun])


def steiner(mass: Expr, d: Triple) -> list[Expr]:
    """Return ``m (d^2 1 - d d^T)``, the tensor of a particle at d, row by row."""
    square = sum((x * x for x in d), start=number(0))
    return [mass * ((square if i == j else 0) - d[i] * d[j]) for i in range(3) for j in range(3)]
