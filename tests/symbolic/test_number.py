"""Numbers from texts, decimals and NumPy's scalars are exact."""

from __future__ import annotations

import math
from decimal import Decimal
from fractions import Fraction
from random import Random

import numpy as np
import pytest

from symbody import Expr, cos, lambdify, log, number, parse, sqrt, symbols
from symbody.errors import ArgumentError, ExpressionError

x = symbols("x")


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("1/2", Fraction(1, 2)),
        (" 3 ", 3),
        ("-7/3", Fraction(-7, 3)),
        ("+4/6", Fraction(2, 3)),
        (" -1 / 2 ", Fraction(-1, 2)),
        ("0.1", Fraction(1, 10)),
        (".5", Fraction(1, 2)),
        ("2.", 2),
        ("1e-3", Fraction(1, 1000)),
        ("1E6", 10**6),
        ("1.5/4", Fraction(3, 8)),
        ("-0", 0),
        ("0.1234567890123456789", Fraction("0.1234567890123456789")),
        ("123456789012345678901234567890", 123456789012345678901234567890),
        ("1e-400", Fraction(1, 10**400)),
        ("9.81", Fraction(981, 100)),
    ],
)
def test_a_text_is_the_number_that_it_says(text: str, value: Fraction | int) -> None:
    assert Fraction(*number(text).ratio) == value


def test_how_it_prints() -> None:
    texts = ("1/2", "0.1", "1e-3", "-7/3", "3", "2.50")
    assert [str(number(text)) for text in texts] == ["1/2", "0.1", "0.001", "-7/3", "3", "2.5"]
    assert number("0.1").same_form(number(0.1))
    assert number("0.1").is_decimal


@pytest.mark.parametrize("value", [Decimal("0.1"), Decimal("-2.5e-7"), Decimal(12), Decimal("1e30")])
def test_decimals_are_exact_wherever_numbers_are(value: Decimal) -> None:
    for made in (number(value), number(str(value)), parse(str(value)), (value * (x + 1)).subs({x: 0})):  # type: ignore[operator]
        assert Fraction(*made.ratio) == Fraction(value)


def test_a_decimal_of_many_digits() -> None:
    value = Decimal("0.12345678901234567890123")
    assert Fraction(*number(value).ratio) == Fraction(value)


@pytest.mark.parametrize(
    "value", [np.float64(0.1), np.int64(3), np.float32(0.5), np.uint8(7), np.array(2.5), np.array([x])[0]]
)
def test_scalars_of_numpy(value: object) -> None:
    assert number(value) == (value if isinstance(value, Expr) else value.item())  # type: ignore[arg-type,attr-defined]


ONE = "expected one such as '1/2', '-7/3', '0.1' or '1e-3'; parse reads expressions"


@pytest.mark.parametrize(
    "text",
    ["", "x", "0,5", "1/2/3", "1//2", "pi/2", "nan", "inf", "-inf", "1_000", "0x10", "1e", "--1", "1 2", "½", "١", "2j",
     "50%"],
)  # fmt: skip
def test_texts_of_no_number(text: str) -> None:
    with pytest.raises(ExpressionError) as caught:
        number(text)
    assert str(caught.value) == f"number: {text!r} is not a number; {ONE}"


@pytest.mark.parametrize("text", ["1/0", "0/0", "1/0.0", "1/-0"])
def test_a_zero_below_the_line(text: str) -> None:
    with pytest.raises(ExpressionError, match=r"divided by zero|is not a number"):
        number(text)


@pytest.mark.parametrize("value", ["1e9999999999", "1e-99999999", Decimal("1e4000000")])
def test_numbers_that_fill_the_memory(value: str | Decimal) -> None:
    with pytest.raises(ExpressionError, match="more than a million digits"):
        number(value)
    with pytest.raises(ExpressionError, match="more than a million digits"):
        parse(str(value))


@pytest.mark.parametrize("value", [None, True, 1j, np.bool_(True), b"1", [1]])
def test_what_is_no_number(value: object) -> None:
    with pytest.raises(ArgumentError, match="expected an expression or a number"):
        number(value)  # type: ignore[arg-type]


@pytest.mark.parametrize("compiled", [False, True])
def test_a_coefficient_beyond_the_doubles_is_applied_in_parts(*, compiled: bool) -> None:
    u = symbols("u")
    cases = [
        (u * 10**400, 1e-300, 1e100),
        (u / 10**400, 1e300, 1e-100),
        (-u * 10**400 + 1, -1e-300, 1e100),
        (u * 10**500, 1e-250, 1e250),
        (u**2 * Fraction(1, 10**350), 1e150, 1e-50),
    ]
    for expression, value, expected in cases:
        assert expression.evaluate({u: value}) == pytest.approx(expected, rel=1e-14)
        assert lambdify([u], expression, compile=compiled)(value) == pytest.approx(expected, rel=1e-14)
    assert (u * 10**400).evaluate({u: 1.0}) == float("inf")


def test_products_with_coefficients_beyond_the_doubles_neither_overflow_nor_underflow() -> None:
    random = Random(2)
    u, v, w = symbols("u v w")
    for _ in range(300):
        factor = Fraction(3 * 10 ** random.choice([350, 400, 900])) ** random.choice([-1, 1])
        powers = {name: random.choice([1, 1, 2, -1, -2, 3]) for name in (u, v, w)}
        point = {name: random.choice([-1, 1]) * 10 ** random.uniform(-300, 300) for name in powers}
        exact = factor
        expression = number(factor)
        for name, power in powers.items():
            exact *= Fraction(point[name]) ** power
            expression *= name**power
        found = expression.evaluate(point)
        if abs(exact) > Fraction(1.7e308):
            assert abs(found) == float("inf")
        elif abs(exact) < Fraction(2.3e-308):
            assert abs(found) < 2.3e-308
        else:
            assert found == pytest.approx(float(exact), rel=1e-14)


def test_such_products_in_compiled_code() -> None:
    u, v = symbols("u v")
    for compiled in (False, True):
        product = lambdify([u, v], [u * v * 10**400, 1 + u * v * 10**400, u / v / 10**400], compile=compiled)
        assert product(1e-200, 1e-250) == pytest.approx([1e-50, 1.0, 0.0], rel=1e-15)
        assert product(1e-80, 1e-80) == pytest.approx([1e240, 1e240, 0.0], rel=1e-15)
        assert product(1e100, 1e-300)[[0, 2]] == pytest.approx([1e200, 1.0], rel=1e-15)


def test_logarithms_and_powers_of_numbers_beyond_the_doubles() -> None:
    u = symbols("u")
    large, unit = number(10) ** 400, 400 * math.log(10)
    assert float(log(large)) == pytest.approx(unit, rel=1e-15)
    assert float(sqrt(large * 10 + 7)) == pytest.approx(math.sqrt(10) * 1e200, rel=1e-14)
    cases = [
        (log(large * u), 2.0, unit + math.log(2)),
        (log(u / large), 2.0, math.log(2) - unit),
        (large**u, 0.75, 1e300),
        ((1 / large) ** u, 0.75, 1e-300),
        ((large * u) ** u, 0.5, 0.5**0.5 * 1e200),
    ]
    for expression, value, expected in cases:
        assert expression.evaluate({u: value}) == pytest.approx(expected, rel=1e-13)
        assert lambdify([u], expression, compile=True)(value) == pytest.approx(expected, rel=1e-13)


def test_roots_of_very_long_powers_take_no_time_by_trial_division() -> None:
    assert number(7) ** 200_000 == (number(7) ** 400_000) ** Fraction(1, 2)


def test_a_decimal_stays_one_after_its_fraction_and_large_numbers() -> None:
    assert number(3**100 + 1) != 0
    assert str(cos(number(Fraction(7, 16)))) == "cos(7/16)"
    assert str(cos(number(0.4375))) == "cos(0.4375)"
    assert cos(number(0.4375)) == cos(number(Fraction(7, 16)))
