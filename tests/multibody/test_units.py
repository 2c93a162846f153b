"""Units of names: none is told that the model doesn't show."""

from __future__ import annotations

import pytest

from symbody import (
    Body,
    Expr,
    Force,
    Point,
    System,
    air_force,
    contact,
    functions_of_time,
    ground,
    number,
    rotate,
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


def pushed(force: Expr) -> System:
    return System([CART], [Force(ground, force, 0, 0, at=CART.center_of_mass, on=CART)], coordinates=[x])


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
