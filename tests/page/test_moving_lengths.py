"""Links whose lengths move: flat squares, and one product for the rates of angles that add up."""

from __future__ import annotations

import re

import pytest

from symbody import (
    Body,
    Frame,
    System,
    Vector,
    describe,
    functions_of_time,
    ground,
    newton_euler,
    parse,
    rotate,
    symbols,
    translate,
)

p, q, l, s = functions_of_time("p q l s")
a, b, g, m, M, J = symbols("a b g m M J")


def _system(*places: Frame) -> System:
    bodies = [Body(place, mass, Iz=J) for place, mass in zip(places, (m, M), strict=False)]
    return System(bodies, coordinates=[p, q, l], gravity=Vector(ground, 0, -g, 0))


PAGES = {
    "telescopic second link": (
        _system(rotate("Z", p) * translate(a, 0, 0) * rotate("Z", q) * translate(l, 0, 0)),
        (
            "(J + m*(l**2 + 2*a*l*cos(q) + a**2))*p'' + (J + m*(l**2 + a*l*cos(q)))*q'' + a*m*sin(q)*l'' "
            "- a*m*l*sin(q)*(2*p'*q' + q'**2) + 2*m*(l + a*cos(q))*(p' + q')*l' "
            "+ g*m*(l*cos(p + q) + a*cos(p)) = 0"
        ),
        (
            "(J + m*(l**2 + a*l*cos(q)))*p'' + (J + m*l**2)*q'' + a*m*l*sin(q)*p'**2 "
            "+ 2*m*l*(p' + q')*l' + g*m*l*cos(p + q) = 0"
        ),
        "a*m*sin(q)*p'' + m*l'' - a*m*cos(q)*p'**2 - m*l*(p' + q')**2 + g*m*sin(p + q) = 0",
    ),
    "slider behind two hinges": (
        _system(rotate("Z", p) * rotate("Z", q) * translate(l, 0, 0)),
        "(J + m*l**2)*p'' + (J + m*l**2)*q'' + 2*m*l*(p' + q')*l' + g*m*l*cos(p + q) = 0",
        "(J + m*l**2)*p'' + (J + m*l**2)*q'' + 2*m*l*(p' + q')*l' + g*m*l*cos(p + q) = 0",
        "m*l'' - m*l*(p' + q')**2 + g*m*sin(p + q) = 0",
    ),
}


@pytest.mark.parametrize("name", PAGES)
def test_rates_of_angles_that_add_up_stand_once(name: str) -> None:
    system, *rows = PAGES[name]
    equations = newton_euler(system)
    shown = re.sub(r"\n {5,}", " ", describe(equations)).splitlines()[1:]
    assert shown == [f"    {row}" for row in rows]
    known = {str(leaf): leaf for leaf in system.leaves}
    assert [parse(row.removesuffix(" = 0"), known) for row in rows] == [*equations.residuals]


def test_long_coefficients_that_are_equal_stand_once() -> None:
    first = rotate("Z", p) * rotate("Z", q) * translate(l, 0, 0)
    second = first * rotate("Z", s) * translate(a, 0, 0)
    system = System([Body(first, m), Body(second, M)], coordinates=[p, q, l, s])
    row = describe(newton_euler(system)).splitlines()[1].strip()
    assert row.startswith("((M + m)*l**2 + M*(2*a*l*cos(s) + a**2))*(p'' + q'')")


def test_differences_with_waves_have_one_direction() -> None:
    turn, lift, roll, swing = functions_of_time("psi theta phi nu")
    boom = rotate("Z", turn) * rotate("Y", -lift) * translate(a, 0, 0)
    load = boom * rotate("Y", lift) * rotate("X", roll) * rotate("Y", swing) * translate(0, 0, -b)
    bodies = [Body(boom, M), Body(load, m)]
    rows = describe(newton_euler(System(bodies, coordinates=[turn, lift, roll, swing])))
    assert rows.count("(a*c_theta - b*s_nu)") + rows.count("(b*s_nu - a*c_theta)") > 3
    assert "(a*c_theta - b*s_nu)" not in rows or "(b*s_nu - a*c_theta)" not in rows
