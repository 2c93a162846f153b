"""Signs of sines inside the arguments of other functions: no equality is false there."""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Callable
from itertools import product

import pytest

from symbody.symbolic import (
    Abs,
    Expr,
    Max,
    Min,
    Piecewise,
    cos,
    exp,
    number,
    sign,
    sin,
    sinh,
    sqrt,
    symbols,
    tan,
    tanh,
)

x, y = symbols("x y")
a = symbols("a", positive=True)
POINTS = [(0.4, 0.7, 1.3), (-0.9, 0.3, 0.6), (1.1, -0.5, 2.2), (-0.3, -1.2, 0.8)]

Value = tuple[Expr, Callable[[float, float, float], float]]


def values() -> list[Value]:
    """Sines, cosines, tangents, and sums with them."""
    return [
        (sin(x), lambda u, v, p: math.sin(u)),
        (sin(x) ** 2, lambda u, v, p: math.sin(u) ** 2),
        (tan(y) ** 2, lambda u, v, p: math.tan(v) ** 2),
        (1 - cos(x), lambda u, v, p: 1 - math.cos(u)),
        (cos(y), lambda u, v, p: math.cos(v)),
        (a - sin(x), lambda u, v, p: p - math.sin(u)),
        (y - 3 * tan(x), lambda u, v, p: v - 3 * math.tan(u)),
        (number(0) * x, lambda u, v, p: 0.0),
        (y, lambda u, v, p: v),
    ]


def choices(one: Value, two: Value) -> list[Value]:
    """Signs, moduli, roots, extrema and piecewise functions of two values."""
    (e, f), (g, h) = one, two
    return [
        (Max(e, g), lambda *at: max(f(*at), h(*at))),
        (Min(e, g), lambda *at: min(f(*at), h(*at))),
        (Abs(e - g), lambda *at: abs(f(*at) - h(*at))),
        (sqrt((e - g) ** 2), lambda *at: abs(f(*at) - h(*at))),
        (sign(1 + e - g), lambda *at: math.copysign(1.0, 1 + f(*at) - h(*at))),
        (Piecewise((e, g), otherwise=y), lambda *at: f(*at) if h(*at) > 0 else at[1]),
        (e - g, lambda *at: f(*at) - h(*at)),
        (g - e, lambda *at: h(*at) - f(*at)),
    ]


OUTER: dict[str, tuple[Callable[[Expr], Expr], Callable[[float], float]]] = {
    "exp": (exp, math.exp),
    "sin": (sin, math.sin),
    "tanh": (tanh, math.tanh),
    "sinh": (sinh, math.sinh),
    "power": (lambda u: number(2) ** u, lambda u: 2.0**u),
    "sine of sine": (lambda u: sin(2 + sin(u)), lambda u: math.sin(2 + math.sin(u))),
    "exp of sine": (lambda u: exp(sin(u)), lambda u: math.exp(math.sin(u))),
    "modulus of exp": (lambda u: Abs(2 - exp(u)), lambda u: abs(2 - math.exp(u))),
}


@pytest.mark.parametrize("name", OUTER)
def test_no_equality_is_false(name: str) -> None:
    outer, function = OUTER[name]
    classes: defaultdict[Expr, list[tuple[float, ...]]] = defaultdict(list)
    for one, two in product(values(), repeat=2):
        for inner, value in choices(one, two):
            classes[outer(inner)].append(tuple(function(value(*at)) for at in POINTS))
    assert len(classes) > 100
    for expression, members in classes.items():
        for member in members:
            assert member == pytest.approx(members[0], rel=1e-9, abs=1e-9), str(expression)


def test_rows_of_a_reader() -> None:
    assert str(exp(Max(0, sin(x) ** 2))) == "exp(Max(0, sin(x)**2))"
    assert exp(-Abs(1 - cos(x))) == exp(cos(x) - 1) != exp(1 - cos(x))
    assert exp(sign(y * sin(x) ** 2)) == exp(sign(y)) != exp(-sign(y))
    assert sin(Min(tan(y), y * y)) != sin(tan(y))
    assert exp(-sqrt((a - 2 * sin(x)) ** 2)) != exp(2 * sin(x) - a)
    assert exp(sin(2 * x)) == exp(2 * sin(x) * cos(x))
    assert sin(sin(2 * x)) == sin(2 * sin(x) * cos(x))
    assert exp(Abs(sin(2 * x))) == exp(2 * Abs(sin(x) * cos(x)))
