"""Frames at numeric angles leave one wave for each angle: ``sin(q + pi/6)``, not ``(sqrt(3)*sin(q) + cos(q))/2``."""

from __future__ import annotations

import random

import pytest

from symbody import (
    Body,
    Expr,
    Force,
    Point,
    System,
    Vector,
    cos,
    describe,
    functions_of_time,
    ground,
    newton_euler,
    number,
    pi,
    project,
    rotate,
    sin,
    sqrt,
    symbols,
    translate,
)
from symbody.symbolic.calculus.phases import with_phases

p, q, x, y = functions_of_time("p q x y")
F1, F2, F3 = functions_of_time("F1 F2 F3")
a, g, l, m, M, J, R = symbols("a g l m M J R")
GRAVITY = Vector(ground, 0, -g, 0)
THIRD = 2 * pi / 3

FORMS = {
    sqrt(3) * sin(q - THIRD) + cos(q - THIRD): "-2*cos(q)",
    sqrt(2) * (p + l * (sin(q) - cos(q))) / 2: "sqrt(2)*p/2 + l*sin(q - pi/4)",
    x + (a - sqrt(3) * (p + l * cos(q)) + l * sin(q)) / 2: "x - sqrt(3)*p/2 + a/2 + l*sin(q - pi/3)",
    (3 * sin(p) * cos(q) + sqrt(3) * sin(p) * sin(q)) / 2: "sqrt(3)*sin(p)*cos(q - pi/6)",
    cos(q) + cos(q + THIRD) + cos(q - THIRD) + a * pi: "pi*a",
    sqrt(3) * a + sin(q) + cos(q): "sqrt(3)*a + sin(q) + cos(q)",
    sin(q) + cos(q): "sin(q) + cos(q)",
    sqrt(3) * sin(p) + cos(q): "sqrt(3)*sin(p) + cos(q)",
    sqrt(5) * sin(q) + cos(q): "sqrt(5)*sin(q) + cos(q)",
}


@pytest.mark.parametrize("given", FORMS, ids=str)
def test_waves_of_one_angle_are_one_where_that_is_shorter(given: Expr) -> None:
    found = with_phases(given)
    assert found == given
    assert str(found) == FORMS[given]


@pytest.mark.parametrize("seed", range(20))
def test_random_sums_keep_their_value_and_get_no_longer(seed: int) -> None:
    draw = random.Random(seed)
    factors = [number(1), -number(1), sqrt(3), -sqrt(3), sqrt(2), a, sqrt(3) * l / 2]
    waves = [wave(angle + draw.randrange(12) * pi / 6) for angle in (p, q, p + q) for wave in (sin, cos)]
    given = sum(
        (draw.choice(factors) * draw.choice(waves) for _ in range(draw.randint(2, 6))), start=number(0)
    )
    found = with_phases(given)
    assert len(str(found)) <= len(str(given))
    point = {leaf: draw.uniform(0.5, 2) for leaf in (p, q, a, l)}
    assert found.evaluate(point) == pytest.approx(given.evaluate(point), rel=1e-12, abs=1e-12)


def _cart() -> System:
    place = rotate("Z", pi / 6) * translate(x, 0, 0)
    bob = Body(place * rotate("Z", q) * translate(0, -l, 0), m)
    return System([Body(place, M), bob], coordinates=[x, q], gravity=GRAVITY)


def _three_wheels() -> System:
    robot = Body(translate(x, y, 0) * rotate("Z", q), M, Iz=J)
    wheels = [robot.frame * rotate("Z", pi / 6 + k * THIRD) * translate(R, 0, 0) for k in range(3)]
    pairs = zip(wheels, (F1, F2, F3), strict=True)
    loads = [Force(wheel, 0, force, 0, at=Point(wheel, 0, 0, 0), on=robot) for wheel, force in pairs]
    return System([robot], loads, [x, y, q])


def _leg() -> System:
    crank = rotate("Z", THIRD) * translate(R, 0, 0) * rotate("Z", q - THIRD)
    end = project(Point(crank, l, 0, 0), ground).coordinates
    length = (end[0] - x) ** 2 + (end[1] - y) ** 2 - a**2
    return System(
        [Body(crank, 0, Iz=J), Body(translate(x, y, 0), m)], coordinates=[q, x, y], constraints=[length]
    )


PAGES = {
    "cart on a slope": (
        _cart(),
        "(M + m)*x'' + l*m*cos(q)*q'' - l*m*sin(q)*q'**2 + 1/2*g*(M + m) = 0",
        "l*m*cos(q)*x'' + m*l**2*q'' + g*l*m*sin(q + pi/6) = 0",
    ),
    "robot on three wheels": (
        _three_wheels(),
        "M*x'' = F2*sin(q - pi/6) - F1*sin(q + pi/6) + F3*cos(q)",
        "M*y'' = F1*cos(q + pi/6) - F2*cos(q - pi/6) + F3*sin(q)",
        "J*q'' = R*(F1 + F2 + F3)",
    ),
    "leg of a parallel robot": (
        _leg(),
        "constraint: (1/2*sqrt(3)*R + l*sin(q) - y)**2 + (x + R/2 - l*cos(q))**2 - a**2 = 0",
    ),
}


@pytest.mark.parametrize("name", PAGES)
def test_pages_have_one_wave_for_each_angle(name: str) -> None:
    system, *rows = PAGES[name]
    shown = [line.strip() for line in describe(newton_euler(system)).splitlines()]
    assert shown[-len(rows) :] == rows
