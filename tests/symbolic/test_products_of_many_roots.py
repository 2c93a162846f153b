"""Products and sums of many factors, roots and signs are equal in any order and nesting, and what cancels is gone."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from functools import reduce
from operator import add, mul

import pytest

from symbody.symbolic import Abs, Expr, free_symbols, number, parse, sign, sin, sqrt, subs, symbols

x, y, z, w = symbols("x y z w")
PARTS: dict[str, Callable[[int], Expr]] = {
    "roots": lambda k: sqrt(x**2 + k),
    "lengths": lambda k: sqrt((x - k) ** 2 + (y - 2 * k) ** 2),
    "signs": lambda k: sign(x - k * y),
    "moduli": lambda k: Abs(x - k),
}


@pytest.mark.parametrize("count", [6, 7, 20, 60])
@pytest.mark.parametrize("operation", [mul, add])
@pytest.mark.parametrize("name", PARTS)
def test_any_order(name: str, operation: Callable[[Expr, Expr], Expr], count: int) -> None:
    parts = [PARTS[name](k) for k in range(1, count + 1)]
    one, other = reduce(operation, parts), reduce(operation, parts[::-1])
    assert one == other
    assert (one - other).is_zero
    assert one - other == number(0)
    assert parse(str(one)) == one
    assert parse(str(other)) == other
    assert one != operation(one, parts[0])


@pytest.mark.parametrize("whole", [15, 10**25 + 3])
def test_roots_of_a_number_that_make_it_are_the_number(whole: int) -> None:
    root = number(whole) ** Fraction(1, 3)
    assert (root**2 * root).kind == "number"
    assert (sqrt(3) * (sqrt(5) * sqrt(whole))) == sqrt(15 * whole)
    assert sqrt((root**2 * root + 67) * x) == sqrt((whole + 67) * x)


@pytest.mark.parametrize(
    "quotient",
    [
        x * y * z / y,
        x * y * z * w / y,
        z * (x * (y * w)) / y,
        x * sin(z) * y / (w * y),
        (x * (z / y)) * (w * y),
        (w * (x * y * z)) / (z * (x * y)),
        reduce(mul, symbols("s:30"), y) / y,
    ],
    ids=str,
)
def test_a_factor_that_is_divided_by_is_gone_at_any_depth(quotient: Expr) -> None:
    assert y not in free_symbols([quotient])
    assert subs(quotient, {y: 0}) == quotient
