"""Units of names: none is told that the model doesn't show."""

from __future__ import annotations

import pytest

from symbody import (
    Body,
    Expr,
    Force,
    Frame,
    Point,
    System,
    Torque,
    air_force,
    contact,
    cos,
    functions_of_time,
    ground,
    number,
    rotate,
    sin,
    spring,
    symbols,
    t,
    time_derivative,
    translate,
)
from symbody.multibody.quantity.role import units_of_names

x, phi = functions_of_time("x phi")
m, J, F, x0, a, b, c, k, r = symbols("m J F x0 a b c k r")
R, d, mu, v0, rho, A = symbols("R d mu v0 rho A")
CART = Body(translate(x, 0, 0), m)
TUB = Body(translate(x, r, 0), m)
TOUCH = contact(CART.center_of_mass, R, k, damping=d, friction=mu, creep_speed=v0, on=CART)
DRAG = air_force(CART.center_of_mass, on=CART, density=rho, drag_area=A)
PUSHED = "F N, m kg, x m"


def pushed(force: Expr, frame: Frame = CART.frame) -> System:
    cart = Body(frame, m)
    return System([cart], [Force(ground, force, 0, 0, at=cart.center_of_mass, on=cart)], coordinates=[x])


def turned(torque: Expr) -> System:
    """A disc whose radius is known from its inertia alone."""
    disc = Body(rotate("Z", phi), m, Iz=m * r**2 / 2)
    return System([disc], [Torque(ground, 0, 0, torque, on=disc)], coordinates=[phi])


def touching(exponent: Expr | int) -> System:
    law = contact(CART.center_of_mass, R, k, exponent=exponent, on=CART)
    return System([CART], [law], coordinates=[x])


def rolling(shift: Expr, turn: Expr, q: Expr) -> System:
    return System([Body(translate(shift, 0, 0) * rotate("Z", -turn), m, Iz=J)], coordinates=[q])


@pytest.mark.parametrize(
    ("system", "expected"),
    [
        (pushed(F - 100 * (x - x0)), PUSHED),
        (pushed(F - 5 * (time_derivative(x) - x0)), PUSHED),
        (pushed(F - (x - x0)), "m kg, x m"),
        (pushed(2 * F), PUSHED),
        (pushed(F * cos(b * t + a)), "F N, a rad, b rad/s, m kg, x m"),
        (pushed(-k * (x - a) - c * time_derivative(x)), "a m, c N s/m, k N/m, m kg, x m"),
        (pushed(-k * (x - a * sin(b * t))), "a m, b rad/s, k N/m, m kg, x m"),
        (pushed(-k * (2 * x - 5) - c * (time_derivative(x) - v0)), "c N s/m, k N/m, m kg, x m"),
        (pushed(-100 * k * x - c * x * time_derivative(x) - d * x**2), "m kg, x m"),
        (pushed(F / (1 - cos(x))), "m kg, x m"),
        (turned(-k * (phi - a) - c * time_derivative(phi)), "c N m s/rad, k N m/rad, m kg, phi rad, r m"),
        (turned(F * sin(phi) - k * x), "F N m, m kg, phi rad, r m"),
        (
            pushed(-k * x, translate(a * sin(b * t) + x, d * t * cos(c), 0)),
            "a m, b rad/s, c rad, d m/s, k N/m, m kg, x m",
        ),
        (rolling(number("0.3") * phi, phi, phi), "J kg m², m kg, phi rad"),
        (rolling(x, x / number("0.3"), x), "J kg m², m kg, x m"),
        (rolling(r * phi, phi, phi), "J kg m², m kg, phi rad, r m"),
        (
            System(
                [TUB],
                [spring(Point(TUB.frame, a, 0, 0), Point(ground, a + b, c, 0), k, on=TUB)],
                coordinates=[x],
            ),
            "a m, b m, c m, k N/m, m kg, r m, x m",
        ),
        (
            System([CART], [TOUCH, DRAG], coordinates=[x]),
            "A m², R m, d s/m, k N/m^1.5, m kg, mu , rho kg/m³, v0 m/s, x m",
        ),
        (touching(1), "R m, k N/m, m kg, x m"),
        (touching(2), "R m, k N/m^2, m kg, x m"),
        (touching(a), "R m, k N/m^a, m kg, x m"),
    ],
)
def test_units_are_those_that_the_model_shows(system: System, expected: str) -> None:
    """A number before a length may be a stiffness, and before an angle a radius; the ends of a spring are places."""
    found = sorted(f"{name} {unit}" for name, unit in units_of_names(system).items() if name != t)
    assert ", ".join(found) == expected
