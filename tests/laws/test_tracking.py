"""Rates of poses that are constrained: finite wherever the motion is, whatever way the velocities are written."""

from __future__ import annotations

from collections.abc import Callable
from itertools import permutations, product

import numpy as np
import pytest

from symbody import (
    Body,
    Expr,
    Frame,
    System,
    Vector,
    cos,
    expand,
    functions_of_time,
    ground,
    moving_frame,
    newton_euler,
    pi,
    rotate,
    simulate,
    sin,
    substitute,
    symbols,
    tan,
    time_derivative,
    translate,
)
from symbody.errors import SymbodyError
from symbody.geometry.frame.frame_velocity import twist
from symbody.symbolic import combine_trig

x, y, z, a, b, c = functions_of_time("x y z a b c")
w1, w2, w3 = functions_of_time("w1 w2 w3")
R, h = symbols("R h")
PLACES = [dict(zip((a, b, c), places, strict=True)) for places in product((0, pi / 2, pi, 0.4), repeat=3)]


def tracked(pose: Frame, rates: dict[Expr, Expr], form: Callable[[Expr], Expr]) -> dict[Expr, Expr]:
    """Return the rates that a frame finds, whose velocities are those of a pose with given rates."""
    known = {time_derivative(q): rate for q, rate in rates.items()}
    (p, q, r), (u, v, w) = twist(pose)
    written = [form(each) for each in substitute([u, v, w, p, q, r], known)]
    return moving_frame(*written, pose=pose).coordinate_rates


def has_number(expression: Expr, place: dict[Expr, Expr]) -> bool:
    try:
        expression.subs(place)
    except SymbodyError:
        return False
    return True


TWO_ANGLES = [
    translate(x, y, R * cos(b)) * rotate(first, a) * rotate(second, b)
    for first, second in permutations("XYZ", 2)
]
RATES = [
    {a: w3 / cos(b), b: w1},
    {a: w3, b: w1 - w3},
    {a: w3 / sin(b), b: w1},
    {a: w2 * cos(a) + w3, b: w1 * sin(b)},
]
WAYS = [lambda velocity: velocity, expand, lambda velocity: expand(combine_trig(velocity))]


@pytest.mark.parametrize("form", WAYS)
@pytest.mark.parametrize("rates", RATES)
@pytest.mark.parametrize("pose", TWO_ANGLES)
def test_rates_have_numbers_wherever_they_are_finite(
    pose: Frame, rates: dict[Expr, Expr], form: Callable[[Expr], Expr]
) -> None:
    rolling = {x: R * w1 * sin(a), y: R * w2 - w1 * cos(b), **rates}
    found = tracked(pose, rolling, form)
    assert found == rolling
    for place in PLACES:
        for q, rate in found.items():
            assert has_number(rate, place) or not has_number(rolling[q], place), f"{q}' = {rate} at {place}"


CHAINS = [
    (rotate("Z", a) * translate(R, 0, 0) * rotate("X", b), {a: w3, b: w1 * cos(a)}),
    (translate(R * cos(a), R * sin(a), 0), {a: w3}),
    (translate(R * cos(a), R * sin(a), h * a) * rotate("Z", a), {a: w3 / cos(a)}),
    (rotate("X", a) * translate(0, 0, R) * rotate("Y", b) * translate(h, 0, 0), {a: w1, b: w2}),
    (rotate("Z", a) * translate(x, 0, 0), {a: w1, x: w2}),
    (rotate("Y", a) * rotate("Z", b) * rotate("Y", -a), {a: w1, b: w2 / cos(a)}),
    (
        translate(0, 0, R * sin(b)) * rotate("Z", a) * rotate("Y", b) * rotate("X", c),
        {a: w1, b: w2, c: w3 / cos(b)},
    ),
]


@pytest.mark.parametrize("form", WAYS)
@pytest.mark.parametrize(("pose", "rates"), CHAINS)
def test_chains_of_all_kinds(pose: Frame, rates: dict[Expr, Expr], form: Callable[[Expr], Expr]) -> None:
    found = tracked(pose, rates, form)
    assert found == rates
    for place in PLACES:
        for q, rate in found.items():
            assert has_number(rate, place) or not has_number(rates[q], place), f"{q}' = {rate} at {place}"


@pytest.mark.parametrize(("first", "second"), [*permutations("XYZ", 2)])
@pytest.mark.parametrize("way", ["tangent", "cotangent"])
def test_a_disc_that_rolls_upright(first: str, second: str, way: str) -> None:
    """One angular velocity is given by another one: the turn about the vertical is finite where that is."""
    pose = translate(x, y, R * cos(b)) * rotate(first, a) * rotate(second, b)
    third = next(axis for axis in "XYZ" if axis not in {first, second})
    sign = 1 if (first + second) in {"XZ", "YX", "ZY"} else -1
    along = {
        "tangent": {first: w3, second: w1, third: -sign * w3 * tan(b)},
        "cotangent": {first: -sign * w3 / tan(b), second: w1, third: w3},
    }[way]
    place = substitute(twist(pose).linear, {time_derivative(b): w1, time_derivative(a): w3 / cos(b)})
    if way == "cotangent":
        place = substitute(
            twist(pose).linear, {time_derivative(b): w1, time_derivative(a): -sign * w3 / sin(b)}
        )
    level = substitute(place, {time_derivative(x): w2, time_derivative(y): 0})
    rates = moving_frame(*level, *(along[axis] for axis in "XYZ"), pose=pose).coordinate_rates
    expected = w3 / cos(b) if way == "tangent" else -sign * w3 / sin(b)
    assert rates == {x: w2, y: 0, b: w1, a: expected}
    assert has_number(rates[a], {b: 0 if way == "tangent" else pi / 2})


def rolling_disc() -> System:
    """The disc of the textbooks: it rolls and doesn't slip, turns by a, leans by b, and spins by c."""
    m, g = symbols("m g")
    w2 = w3 * tan(b) + time_derivative(c)
    pose = translate(x, y, R * cos(b)) * rotate("Z", a) * rotate("X", b)
    frame = moving_frame(R * w2, -R * w1, 0, w1, w3 * tan(b), w3, pose=pose, name="disc's plane")
    inertia = (m * R**2 / 4, m * R**2 / 2, m * R**2 / 4)
    disc = Body(frame * rotate("Y", c), m, *inertia, name="disc")
    return System([disc], coordinates=[c], speeds=[w1, w3], gravity=Vector(ground, 0, 0, -g))


def test_a_disc_begins_upright() -> None:
    """Nearly upright, a disc that rolls at n rad/s wobbles by ``sin`` of sqrt((12 n^2 - 4 g/R)/5) t."""
    m, g = symbols("m g")
    n, push = 8.0, 1e-4
    start = {w1: push, time_derivative(c): n}
    motion = simulate(newton_euler(rolling_disc()), {m: 2.0, R: 0.5, g: 9.81}, start, t=(0, 3))
    frequency = np.sqrt((12 * n**2 - 4 * 9.81 / 0.5) / 5)
    assert motion[b] == pytest.approx(push / frequency * np.sin(frequency * motion.t), abs=1e-3 * push)
    assert motion[x] == pytest.approx(0.5 * n * motion.t, abs=1e-3)
    assert motion.energy_drift < 1e-9
