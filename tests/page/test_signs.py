"""The order and the signs of terms, and forms that stay as they are."""

from __future__ import annotations

import re

import pytest

from symbody import (
    Expr,
    Matrix,
    cos,
    describe,
    newton_euler,
    readable,
    sin,
    symbols,
)
from symbody.models import full_car, slider_crank

g, R, r, m, a, b, u, k = symbols("g R r m a b u k")


def test_multipliers_stand_in_their_order_after_given_forces() -> None:
    text = " ".join(describe(newton_euler(slider_crank().system)).split())
    assert "= -F*sin(p) + sin(p)*lambda1 - cos(p)*lambda2" in text
    assert "= a*sin(q)*lambda1 - a*cos(q)*lambda2" in text


def test_a_weight_that_a_given_force_carries_is_on_no_side() -> None:
    """Tyres of the car are preloaded by the weight of their wheels."""
    text = describe(newton_euler(full_car().system))
    for row in re.split(r"\n    (?=\S)", text):
        left, equals, right = " ".join(row.split()).rpartition(" = ")
        assert not (equals and "g*mu" in left and "g*mu" in right)


DIVISORS: dict[Expr, str] = {
    b * a / u - m * u - g * k / u: "(a*b - g*k)/u - m*u",
    a / u - b / u: "(a - b)/u",
}


@pytest.mark.parametrize("given", DIVISORS, ids=str)
def test_terms_of_one_divisor_stand_over_it(given: Expr) -> None:
    form = readable(given)
    assert form == given
    assert str(form).count("/u") == 1
    assert str(readable(Matrix([[given]]))[0, 0]) == str(form)


FIXED = [a * b**2 / 2 + b**2 / r**2 + m, a * sin(u) * cos(k) + a * cos(u) * sin(k) + b * a**2 / r]


@pytest.mark.parametrize("given", FIXED, ids=str)
def test_what_is_readable_stays_as_it_is(given: Expr) -> None:
    form = readable(given)
    assert str(readable(form)) == str(form)
