"""Contact of a sphere with a plane, which opens: it pushes and never pulls."""

from __future__ import annotations

from typing import Any

from symbody.errors import LoadError
from symbody.geometry import Frame, Point, Scalar, Vector, frozen_velocity, ground
from symbody.geometry.component.triple import expression
from symbody.geometry.given.argument import checked
from symbody.multibody.body import Body
from symbody.symbolic import ENERGY, Expr, Max, derivation, number, sqrt
from symbody.symbolic.given.arguments import brief

from .attachment import check_bodies, check_fixed, forces, is_fixed, not_negative
from .element import Element
from .expectation import Expectation
from .stored_energy import stored_energy

_WHERE = "contact"


@checked(LoadError)
def contact(
    center: Point,
    radius: Scalar,
    stiffness: Scalar,
    *,
    on: Body,
    plane: Frame = ground,
    reaction: Body | None = None,
    exponent: Scalar | None = None,
    damping: Scalar = 0,
    friction: Scalar = 0,
    creep_speed: Scalar | None = None,
    name: str = "",
) -> Element:
    """Return the force of a plane on a sphere that overlaps it by delta: ``N = k delta^n max(1 + d delta', 0)``.

    The law is that of Hunt and Crossley [J. Applied Mechanics 42 (1975), p. 440]: the damping vanishes with the
    overlap, so that the force begins and ends with zero. It never pulls. With friction, ``-mu N v/sqrt(v^2 + v0^2)``
    acts against the velocity v with which the sphere slides.

    Args:
        center: the centre of the sphere, fixed in the body.
        radius: the radius, in m; zero for a point.
        stiffness: k, in N/m^n; for Hertz's contact of a sphere with a plane, ``4/3 E sqrt(R)``.
        on: the body of the sphere.
        plane: the frame whose x-y plane is the surface, with z towards the sphere; the ground by default.
        reaction: the body of the plane; none by default.
        exponent: n; by default 3/2, that of Hertz's contact.
        damping: d, in s/m; for a coefficient of restitution e near 1 and the speed v of the impact, ``3/2 (1 - e)/v``.
        friction: mu, the coefficient of friction.
        creep_speed: v0, the speed below which the sphere counts as sticking; needed with `friction`.
        name: what the contact is called where it is shown.

    Returns:
        An element with the potential ``k delta^(n+1)/(n+1)`` and the quantities "overlap", "normal" and "gap". If k,
        n or the radius is a function of time, such as a coordinate, there is no potential.

    >>> from symbody import Body, functions_of_time, symbols, translate
    >>> z, (R, k) = functions_of_time("z"), symbols("R k")
    >>> ball = Body(translate(0, 0, z), 1)
    >>> contact(ball.center_of_mass, R, k, on=ball)["normal"]
    k*Max(0, R - z)**(3/2)
    """
    check_bodies(_WHERE, on, reaction)
    check_fixed(_WHERE, "center", center, on)
    check_fixed(_WHERE, "plane", plane, reaction)
    sizes = not_negative(
        _WHERE,
        radius=radius,
        stiffness=stiffness,
        damping=damping,
        friction=friction,
        creep_speed=creep_speed,
    )
    if expression(stiffness).is_zero:
        raise LoadError(f"{_WHERE}: stiffness = 0, which leaves no force; expected a positive number")
    _check_plane(plane, on)
    mu, n = expression(friction), _exponent(exponent)
    _check_friction(mu, creep_speed)
    with derivation(order=ENERGY):
        x, y, z = center.projected(plane).coordinates
        overlap = Max(radius - z, 0)
        place = Point(plane, x, y, number(0))
        slip = _slip(place, on, plane, reaction)
        factor = expression(damping)
        elastic = expression(stiffness) * overlap**n
        normal = elastic if factor.is_zero else elastic * Max(1 - factor * slip.components[2], 0)
        tangential = number(0), number(0)
        if creep_speed is not None:
            u, v, _ = slip.components
            drag = -mu * normal / sqrt(u**2 + v**2 + creep_speed**2)
            tangential = drag * u, drag * v
        force = Vector(plane, *tangential, normal)
        potential = expression(stiffness) * overlap ** (n + 1) / (n + 1)
        quantities = {"overlap": overlap, "normal": normal, "gap": z - radius}
        actions = forces(force, place, on, reaction)
        return Element(
            _WHERE,
            actions,
            potential=stored_energy(potential, expression(stiffness), expression(radius), n),
            quantities=quantities,
            name=name,
            sizes={**sizes, "exponent": n},
            positive=("stiffness", "creep_speed"),
            expected=[_expected_exponent(n)],
            far_end=plane if reaction is None else None,
        )


def _slip(place: Point, on: Body, plane: Frame, reaction: Body | None) -> Vector:
    """Return the velocity of the body at the contact, relative to the plane, in its axes."""
    carrier = plane if reaction is None else reaction.frame
    return frozen_velocity(place, on.frame, axes=plane) - frozen_velocity(place, carrier, axes=plane)


def _check_plane(plane: Frame, on: Body) -> None:
    if is_fixed(plane, on):
        raise LoadError(
            f"{_WHERE}: plane = {brief(plane)} is fixed in the body {brief(on)} of the sphere; expected a frame of "
            "another body, or the ground"
        )


def _exponent(given: Scalar | None) -> Expr:
    n = number("3/2") if given is None else expression(given)
    fault = _expected_exponent(n).known_fault
    if fault:
        raise LoadError(f"{_WHERE}: {fault}")
    return n


def _expected_exponent(n: Expr) -> Expectation:
    return Expectation((n,), _is_below_one, _exponent_fault)


def _is_below_one(n: Any) -> Any:
    return n < 1


def _exponent_fault(n: float) -> str:
    return f"exponent = {n:.6g}; expected 1 or more, such as 1.5 for Hertz's contact"


def _check_friction(mu: Expr, creep_speed: Scalar | None) -> None:
    if mu.is_zero:
        if creep_speed is not None:
            raise LoadError(
                f"{_WHERE}: creep_speed without friction, which acts by it alone; expected friction=mu, or neither"
            )
        return
    if creep_speed is None or expression(creep_speed).is_zero:
        raise LoadError(
            f"{_WHERE}: friction = {brief(mu)} without creep_speed; expected the speed below which the sphere counts "
            "as sticking, such as 0.001: friction by the direction of the velocity alone jumps at rest"
        )
