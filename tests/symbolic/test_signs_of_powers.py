"""Signs of powers with symbolic exponents: a negative base has odd powers that are negative."""

from __future__ import annotations

from fractions import Fraction

import pytest

from symbody.symbolic import Abs, Expr, Max, Min, atan2, exp, log, number, pi, sign, symbols

x, y = symbols("x y")
a = symbols("a", positive=True)


@pytest.mark.parametrize("name", [f"n{k}" for k in range(8)])
@pytest.mark.parametrize("base", [x, -a, x * a, log(a), number(-2), sign(x)])
def test_the_sign_of_a_power_of_what_may_be_negative_is_not_known(base: Expr, name: str) -> None:
    """Whatever the name of the exponent is: at the exponent 3 the sign is that of the base, at 2 it is 1."""
    exponent = symbols(name)
    power = base**exponent
    assert sign(power) not in {number(1), sign(base)}
    assert sign(power) != sign(base ** (exponent + 1))
    assert Abs(power) != power


def test_a_choice_of_exponents_is_a_choice_of_signs() -> None:
    """Where x < 0, the power is x for some values of y, and the square of x for others."""
    power = x ** Min(2, Max(1, y))
    assert sign(power) not in {number(1), sign(x)}


@pytest.mark.parametrize("power", [a**y, (x**2) ** y, exp(x) ** y, number(3) ** (x * y), exp(y * log(a))])
def test_powers_of_what_is_positive_are_positive(power: Expr) -> None:
    assert sign(power) == 1
    assert Abs(power) == power


@pytest.mark.parametrize("degree", [2, 3, 5])
def test_the_exponential_of_the_logarithm_of_a_hidden_sign_is_that_sign(degree: int) -> None:
    """The logarithm of a sign that is known in no lane alone asks for the signs of every lane."""
    hidden = sign(atan2(a, pi) ** Fraction(1, degree))
    assert exp(log(hidden)) == hidden
