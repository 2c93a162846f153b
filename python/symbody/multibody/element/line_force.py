"""Forces along the line between two points: cables, cylinders, dampers with laws of the user."""

from __future__ import annotations

from symbody.errors import LoadError
from symbody.geometry import Point, Scalar
from symbody.geometry.component.triple import expression
from symbody.geometry.given.argument import checked
from symbody.multibody.body import Body
from symbody.symbolic import ENERGY, derivation

from .attachment import check_apart, check_bodies, check_fixed, forces
from .element import Element
from .line import line_between

_WHERE = "line_force"


@checked(LoadError)
def line_force(
    force: Scalar, at: Point, to: Point, *, on: Body, reaction: Body | None = None, name: str = ""
) -> Element:
    """Return any force along the line between two points; it pulls them together if it is positive.

    Args:
        force: the force F, in N, such as an input, or a law of the quantities of a `spring` at the same points.
        at: the point of the body.
        to: the other point.
        on: the body.
        reaction: the body of the other point; none by default, such as the ground.
        name: what the force is called where it is shown.

    Returns:
        An element without a potential, with the quantities "length", "rate" and "force".

    >>> from symbody import Body, Point, functions_of_time, ground, power, symbols, translate
    >>> x, (F, b) = functions_of_time("x"), symbols("F b", positive=True)
    >>> cart = Body(translate(x, 0, 0), 1)
    >>> cable = line_force(F, cart.center_of_mass, Point(ground, 0, b, 0), on=cart)
    >>> power(cable)
    -F*x*x'/sqrt(x**2 + b**2)
    """
    check_bodies(_WHERE, on, reaction)
    check_fixed(_WHERE, "at", at, on)
    check_fixed(_WHERE, "to", to, reaction)
    with derivation(order=ENERGY):
        line, size = line_between(at, to, _WHERE), expression(force)
        check_apart(_WHERE, to, on, reaction)
        actions = forces(line.vector * (size / line.length), at, on, reaction, to)
        quantities = {"length": line.length, "rate": line.rate, "force": size}
    return Element(
        _WHERE,
        actions,
        quantities=quantities,
        name=name,
        undefined=line.undefined,
        law={"force": size},
        ends=(at, to),
        far_end=to if reaction is None else None,
    )
