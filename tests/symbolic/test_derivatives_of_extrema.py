"""Derivatives of moduli, Max and Min against finite differences, also where several arguments are the extremum."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction

import pytest

from symbody import (
    Abs,
    Expr,
    Max,
    Min,
    Piecewise,
    asin,
    diff,
    functions_of_time,
    gradient,
    sign,
    sqrt,
    symbols,
    t,
    time_derivative,
)

x, y, w = symbols("x y w")

AGREEING: dict[str, tuple[Expr, float]] = {
    "modulus": (Max(x, Abs(x), w), 2.0),
    "two moduli": (Max(x, Abs(x), Max(x, 0), w), 2.0),
    "positive part": (Max(w, x, Max(x, 0)), 2.0),
    "two bounds": (Max(w, Min(x, 1), Min(x, 2)), 0.5),
    "opposite modulus": (Min(x, -Abs(x), Max(w, 0)), -2.0),
    "saturated": (Max(x, 2 * x, Min(2 * x, 10), w), 2.0),
    "unrelated": (Max(x**2, y, w, x + 3), 4.0),
    "not the greatest": (Max(x, y + 9, w), 2.0),
}


@pytest.mark.parametrize("name", AGREEING)
def test_arguments_that_agree_count_once(name: str) -> None:
    extremum, place = AGREEING[name]
    fixed = {y: 0.3, w: -1.0}

    def at(value: float) -> float:
        return extremum.evaluate({**fixed, x: value})

    slope = (at(place + 1e-5) - at(place - 1e-5)) / 2e-5
    for derivative in (diff(extremum, x), gradient(extremum, [x])[0]):
        assert derivative.evaluate({**fixed, x: place}) == pytest.approx(slope, abs=1e-8)


@pytest.mark.parametrize("extremum", [Max, Min])
def test_the_weights_of_all_arguments_add_up_to_one(extremum: Callable[..., Expr]) -> None:
    a, b, c, d = symbols("a b c d")
    weights = gradient(extremum(a, b, c, d), [a, b, c, d])
    for place in ({a: 1, b: 2, c: 3, d: 4}, {a: 2, b: 2, c: 1, d: 2}, {a: 0, b: 0, c: 0, d: 0}):
        assert sum(weight.evaluate(place) for weight in weights) == 1


def test_the_rate_of_an_extremum() -> None:
    q = functions_of_time("q")
    rate = time_derivative(Max(q, Abs(q), w))
    assert rate.evaluate({q: 2, q.diff(t): 1, w: -1}) == 1


@pytest.mark.parametrize("degree", [Fraction(1, 2), Fraction(-1, 2), Fraction(3, 2), Fraction(1, 3)])
def test_extrema_of_what_may_not_be_real_have_the_derivatives_of_their_branches(degree: Fraction) -> None:
    a, root = symbols("a", positive=True), x**degree
    for extremum, ahead in ((Min(root, a), root - a), (Max(root, a), a - root)):
        branches = Piecewise((a, ahead), otherwise=root)
        assert extremum == branches
        assert diff(extremum, x) == diff(branches, x)


@pytest.mark.parametrize("place", [0.3, 3.0])
def test_the_modulus_of_what_may_not_be_real(place: float) -> None:
    modulus = Abs(sqrt(y) - x)
    fixed = {x: 1.0, y: place}
    slope = (
        modulus.evaluate({**fixed, y: place + 1e-6}) - modulus.evaluate({**fixed, y: place - 1e-6})
    ) / 2e-6
    assert diff(modulus, y).evaluate(fixed) == pytest.approx(slope, rel=1e-8)
    assert gradient(1 / modulus, [x, y]) == gradient(Abs(1 / (sqrt(y) - x)), [x, y])
    assert diff(sign(sqrt(y) - x), y) == diff((sqrt(y) - x) / modulus, y) == 0


def test_the_modulus_of_a_length_that_is_not_known_to_be_real_has_a_derivative_where_it_is_zero() -> None:
    length = sqrt(x**4 - 2 * x**3 * y + 2 * x**2 * y**2 - 2 * x * y**3 + y**4)
    slope = diff(Abs(length - w), w)
    assert slope == -sign(length - w)
    assert slope.evaluate({x: 1, y: 0, w: 1}) == 0


def test_the_gradient_of_what_is_constant_by_value_divides_by_nothing() -> None:
    root = sqrt(Fraction(3, 2))
    mean = (2 * root + y * (1 - x) * root + x * y * root) / (y + 2)
    assert gradient(asin(mean), [x, y]) == (0, 0)
