"""Steps of an integrator, unrolled in symbols: sines of sums of sines, hundreds of them deep."""

from __future__ import annotations

from math import sin as sine
from time import process_time

import pytest

from symbody import Expr, number, sin, symbols

h, theta, omega = symbols("h theta omega")


def unrolled(step: Expr, steps: int) -> Expr:
    """Return a pendulum's angle after steps of the semi-implicit Euler method."""
    angle, speed = theta, omega
    for _ in range(steps):
        speed = speed - step * sin(angle)
        angle = angle + step * speed
    return angle


@pytest.mark.parametrize("step", [h, number(0.01), number("1/100")], ids=["h", "0.01", "1/100"])
def test_unrolled_steps_take_a_time_in_proportion(step: Expr) -> None:
    """200 steps took 18 s when the argument of each sine was multiplied out to see that it is too long."""
    started = process_time()
    unrolled(step, 400)
    assert process_time() - started < 2


def test_unrolled_steps_have_the_numbers_of_the_loop() -> None:
    angle, speed = 0.4, 0.1
    for _ in range(60):
        speed -= 0.01 * sine(angle)
        angle += 0.01 * speed
    found = unrolled(h, 60).evaluate({h: 0.01, theta: 0.4, omega: 0.1})
    assert found == pytest.approx(angle, rel=1e-13)


def test_short_arguments_are_still_multiplied_out() -> None:
    """Arguments of up to 256 terms are equal by their terms, longer ones by their values."""
    terms = symbols("a0:16")
    total = sum(terms, number(0))
    squares = sum((a * b for a in terms for b in terms), number(0))
    assert sin(total**2 + h) == sin(squares + h)
    assert sin(total * total) * sin(h) != 0
