"""Drag and lift of the air."""

from __future__ import annotations

from symbody.errors import LoadError
from symbody.geometry import Point, Scalar, Vector, cross, dot, frozen_velocity
from symbody.geometry.component.triple import expression
from symbody.geometry.given.argument import checked
from symbody.multibody.body import Body
from symbody.symbolic import ENERGY, Expr, derivation, number
from symbody.symbolic.given.arguments import brief

from .attachment import check_fixed, forces, not_negative
from .element import Element
from .norm import norm

_WHERE = "air_force"


@checked(LoadError)
def air_force(
    at: Point,
    *,
    on: Body,
    density: Scalar,
    drag_area: Scalar = 0,
    lift_area: Scalar = 0,
    span: Vector | None = None,
    wind: Vector | None = None,
    name: str = "",
) -> Element:
    """Return the drag ``-1/2 rho A_D |v| v`` and the lift ``1/2 rho A_L |v| v x s`` of a body that moves through air.

    v is the velocity of the body at the point, less that of the wind. The lift is across v and the span s.

    Args:
        at: the point of the body where the force acts, such as its centre of pressure.
        on: the body.
        density: rho of the air, in kg/m^3.
        drag_area: A_D, the drag coefficient times the area, in m^2.
        lift_area: A_L, the lift coefficient times the area, in m^2; it may depend on the angle of attack.
        span: s, a unit vector; with x forward and z up, the y axis of the body, for lift upwards.
        wind: the velocity of the air; none by default.
        name: what the force is called where it is shown.

    Returns:
        An element without a potential, with the quantities "speed", "drag" and "lift".

    >>> from symbody import Body, functions_of_time, power, symbols, translate
    >>> x, (rho, A) = functions_of_time("x"), symbols("rho A")
    >>> car = Body(translate(x, 0, 0), 1)
    >>> power(air_force(car.center_of_mass, on=car, density=rho, drag_area=A))
    -A*rho*Abs(x')*x'**2/2
    """
    check_fixed(_WHERE, "at", at, on)
    lifting = expression(lift_area)
    sizes = not_negative(_WHERE, density=density, drag_area=drag_area)
    _check_span(lifting, span)
    if lifting.is_zero and expression(drag_area).is_zero:
        raise LoadError(f"{_WHERE}: neither drag_area nor lift_area; expected at least one of them")
    if expression(density).is_zero:
        raise LoadError(f"{_WHERE}: density = 0, which leaves no force; expected a positive number")
    with derivation(order=ENERGY):
        v = frozen_velocity(at, on.frame)
        if wind is not None:
            v -= wind
        speed = norm(v)
        half = expression(density) * speed / 2
        force = v * (-half * drag_area)
        if span is not None:
            force += cross(v, span) * (half * lifting)
        quantities = {
            "speed": speed,
            "drag": half * speed * drag_area,
            "lift": number(0) if span is None else half * lifting * norm(cross(v, span)),
        }
        return Element(_WHERE, forces(force, at, on, None), quantities=quantities, name=name, sizes=sizes)


def _check_span(lifting: Expr, span: Vector | None) -> None:
    if span is None and not lifting.is_zero:
        raise LoadError(
            f"{_WHERE}: lift_area = {brief(lifting)} without span; expected the unit vector along the wing, such as "
            "span=Vector(body.frame, 0, 1, 0)"
        )
    if span is not None and dot(span, span) != 1:
        raise LoadError(
            f"{_WHERE}: span = {brief(span)} isn't of length 1; expected a unit vector, such as "
            "Vector(body.frame, 0, 1, 0)"
        )
