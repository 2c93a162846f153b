"""Sines of sums with multiples of pi: quarter turns leave the argument, wherever in it they stand."""

from __future__ import annotations

import math
from collections.abc import Callable

import pytest

from symbody import (
    Expr,
    SymbodyError,
    cos,
    derivation,
    expand_trig,
    functions_of_time,
    number,
    pi,
    sin,
    symbols,
    tan,
)

x, y, z = symbols("x y z")
q = functions_of_time("q")


@pytest.mark.parametrize("fresh", [False, True])
@pytest.mark.parametrize("angle", [x, q, -y, x - y, x + y, 2 * x])
def test_all_quarter_turns_leave_the_argument(angle: Expr, fresh: bool) -> None:
    def shapes() -> set[str]:
        turned = [angle + k * pi / 2 for k in range(-8, 8)] + [k * pi / 2 - angle for k in range(-8, 8)]
        return {str(wave(each)) for wave in (sin, cos) for each in turned}

    if fresh:
        with derivation(fresh=True):
            found = shapes()
    else:
        found = shapes()
    plain = {str(sin(angle)), str(-sin(angle)), str(cos(angle)), str(-cos(angle))}
    assert found == plain, "of an angle there are four"


DENAVIT_HARTENBERG: list[tuple[Callable[[], Expr], str]] = [
    (lambda: cos(q - pi / 2), "sin(q)"),
    (lambda: sin(q - math.pi), "-sin(q)"),
    (lambda: tan(q - pi / 2), "-1/tan(q)"),
    (lambda: cos(pi / 2 - x - y), "sin(x + y)"),
    (lambda: cos(x - (y + (z - pi))), "-cos(x - y - z)"),
    (lambda: sin((x + pi / 4) + (y + pi / 4)), "cos(x + y)"),
    (lambda: cos(2 * (x + pi / 4)), "-sin(2*x)"),
    (lambda: sin(1 - (x - pi)), "sin(x - 1)"),
    (lambda: cos(x - pi / 3), "cos(x - pi/3)"),
]


@pytest.mark.parametrize(("wave", "text"), DENAVIT_HARTENBERG)
def test_the_form_does_not_depend_on_how_the_sum_was_written(wave: Callable[[], Expr], text: str) -> None:
    assert str(wave()) == text
    with derivation(fresh=True):
        assert str(wave()) == text


def test_values_are_those_of_the_whole_argument() -> None:
    for k in range(-8, 8):
        for wave, plain in ((sin, math.sin), (cos, math.cos)):
            angle = (x - k * pi / 2) - (y - pi / 4)
            assert wave(angle) == expand_trig(wave(angle))
            found = wave(angle).evaluate({x: 0.3, y: 1.1})
            assert found == pytest.approx(plain(0.3 - k * math.pi / 2 - 1.1 + math.pi / 4), abs=1e-14)


def test_long_and_deep_sums_keep_their_pi() -> None:
    """In long sums pi is found where it is a term, and deep ones are searched for a while."""
    many = symbols("a0:200")
    assert cos(sum(many, number(0)) + pi / 2) == -sin(sum(many, number(0)))
    chain = x + pi / 2
    for each in many:
        chain = chain + each
    assert cos(chain) == -sin(chain - pi / 2)


@pytest.mark.parametrize("count", [3, 10**9 + 7, 10**16 + 61, 10**25 + 3])
def test_quarter_turns_of_any_number_are_known_where_a_sum_hides_them(count: int) -> None:
    angle = number(count) * pi / 2
    hidden = angle * sin(x) ** 2 + angle * cos(x) ** 2
    assert cos(hidden) == 0
    assert sin(hidden) == (1 if count % 4 == 1 else -1)
    with pytest.raises(SymbodyError, match="tan is not defined at"):
        tan(hidden)
