"""Products do not depend on the order or the grouping of their factors."""

from __future__ import annotations

import random

import pytest

from symbody import Abs, Expr, Max, Min, acos, asin, derivation, exp, pi, sign, sin, sqrt, symbols
from tests.repeated import repeated

x, y, c = symbols("x y c")
l = symbols("l", positive=True)
FACTORS = [
    *(Abs(y), Abs(y), Abs(x), sqrt(x), sqrt(x), x, Abs(x * c), c, sqrt(y**2 * c), sign(x)),
    *(sqrt(2 * l), l**2, exp(x), exp(-y), sin(x) ** 2, 1 / (x + y), (x + y) ** 2, sqrt(x + y)),
]


def grouped(factors: list[Expr], choice: random.Random) -> Expr:
    """Multiply neighbours in a random order."""
    left = choice.sample(factors, len(factors))
    while len(left) > 1:
        i = choice.randrange(len(left) - 1)
        left[i : i + 2] = [left[i] * left[i + 1]]
    return left[0]


@pytest.mark.parametrize("seed", [*range(15), *repeated(range(15, 40))])
@pytest.mark.parametrize("values", [False, True], ids=["forms", "values"])
def test_any_grouping_is_the_same_value(seed: int, values: bool) -> None:
    choice = random.Random(seed)
    some = choice.sample(FACTORS, 8)
    expected = grouped(some, random.Random(-1 - seed))
    if values:
        with derivation():
            assert grouped(some, choice) == expected
    else:
        assert grouped(some, choice) == expected


@pytest.mark.parametrize(
    ("left", "right"),
    [
        (Max(x, y) + Min(x, y), x + y),
        (Min(-x, -y), -Max(x, y)),
        (Max(x, y) - Min(x, y), Abs(x - y)),
        (Abs(x) * sign(x), x),
        (Abs(x * y), Abs(x) * Abs(y)),
        (asin(x) + acos(x), pi / 2),
        (acos(-x), pi - acos(x)),
        (Abs(x * y**2), y**2 * Abs(x)),
        ((Abs(y) * c) ** 2, y**2 * c**2),
    ],
)
def test_real_functions_by_the_modulus(left: Expr, right: Expr) -> None:
    assert left == right
    assert left != -right


def test_complex_symbols_have_no_modulus_rules() -> None:
    z = symbols("z", real=False)
    assert sqrt(z**2) != Abs(z)
    assert Abs(z) ** 2 != z**2
    assert exp(z) != Abs(exp(z))


def test_symbols_of_one_name_stay_apart_in_print() -> None:
    positive = symbols("x", positive=True)
    assert str(positive - x) == "x[positive] - x"
    assert str(positive / x) == "x[positive]/x"


def test_derivatives_of_extrema_agree_with_the_modulus() -> None:
    assert (Max(x, y) + Min(x, y)).diff(x) == 1
    assert (Max(x, y) - Min(x, y)).diff(x) == Abs(x - y).diff(x)
    assert [Max(x, y).diff(x).evaluate({x: a, y: 2.0}) for a in (1.0, 3.0)] == [0.0, 1.0]
    assert [Min(x, y).diff(x).evaluate({x: a, y: 2.0}) for a in (1.0, 3.0)] == [1.0, 0.0]
