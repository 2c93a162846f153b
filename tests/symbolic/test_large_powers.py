"""Rewrites that a user requests do what they promise, or say why not."""

from __future__ import annotations

from math import comb
from random import Random

import pytest

from symbody import (
    Expr,
    atan,
    coeff,
    collect,
    cos,
    cosh,
    expand,
    expand_trig,
    from_sympy,
    functions_of_time,
    number,
    pi,
    sin,
    sinh,
    sqrt,
    symbols,
    tan,
    tanh,
    to_sympy,
)
from symbody.errors import ExpressionError

a, b, c, d, x, y, z = symbols("a b c d x y z")
q = functions_of_time("q")


@pytest.mark.parametrize("n", [256, 257, 300, 1000])
def test_a_power_of_any_exponent_is_expanded(n: int) -> None:
    expanded = expand((x + y) ** n)
    assert expanded.kind == "sum"
    assert len(expanded.args) == n + 1
    assert expanded == (x + y) ** n
    assert coeff((x + y) ** n, x, 2) == comb(n, 2) * y ** (n - 2)
    assert collect((x + 1) ** n + y * x, x) == (x + 1) ** n + x * y


def test_limits_count_the_result() -> None:
    power = (a + b + c + d) ** 60
    expanded = expand(power)
    assert expanded == power
    assert expanded.kind == "sum"
    assert expand((sqrt(a) + b) ** 300) == (sqrt(a) + b) ** 300
    assert expand((1 + sqrt(2)) ** 300) == (1 + sqrt(2)) ** 300


@pytest.mark.parametrize(
    ("n", "message"),
    [
        (30_000, "terms handled while expanding an expression: at most 5000000, found "),
        (200_000, "terms of an expanded expression: at most 200000, found 200001"),
        (10**30, "terms of an expanded expression: at most 200000, found more than can be counted"),
    ],
)
def test_what_is_too_large_is_refused(n: int, message: str) -> None:
    for request in (expand, lambda e: collect(e, x)):
        with pytest.raises(ExpressionError, match=message):
            request((x + y) ** n)


@pytest.mark.parametrize(
    ("wave", "text"),
    [
        (sin(2 * x), "2*sin(x)*cos(x)"),
        (cos(2 * q), "cos(q)**2 - sin(q)**2"),
        (cos(3 * x), "cos(x)**3 - 3*sin(x)**2*cos(x)"),
        (sin(a + 2 * b), "sin(a)*cos(b)**2 - sin(a)*sin(b)**2 + 2*cos(a)*sin(b)*cos(b)"),
        (sin(2 * x) / cos(x), "2*sin(x)"),
        (sin(x / 2) + sin(x), "sin(x/2) + 2*sin(x/2)*cos(x/2)"),
        (sin(x + 2), "sin(2)*cos(x) + cos(2)*sin(x)"),
        (sin(3 * x / 2), "sin(3*x/2)"),
        (sin(0.5 * x), "sin(0.5*x)"),
        (tan(x), "tan(x)"),
        (tan(2 * x), "2*tan(x)/(1 - tan(x)**2)"),
        (tan(x + y), "(tan(x) + tan(y))/(1 - tan(x)*tan(y))"),
        (tan(x - y) ** 2, "(tan(x) - tan(y))**2/(1 + tan(x)*tan(y))**2"),
        (tan(x + pi / 4), "(1 + tan(x))/(1 - tan(x))"),
        (tan(2 * atan(x)), "2*x/(1 - x**2)"),
        (sinh(x + y), "sinh(x)*cosh(y) + cosh(x)*sinh(y)"),
        (cosh(2 * x), "sinh(x)**2 + cosh(x)**2"),
        (cosh(x - y), "cosh(x)*cosh(y) - sinh(x)*sinh(y)"),
        (tanh(x + y), "(tanh(x) + tanh(y))/(1 + tanh(x)*tanh(y))"),
        (tanh(3 * x), "(tanh(x)**3 + 3*tanh(x))/(1 + 3*tanh(x)**2)"),
        (sin(x / 2) + cosh(x), "sin(x/2) + cosh(x)"),
        (tanh(3 * x / 2), "tanh(3*x/2)"),
    ],
)
def test_integer_multiples_of_angles_are_expanded(wave: Expr, text: str) -> None:
    assert str(expand_trig(wave)) == text
    assert expand_trig(wave) == wave


@pytest.mark.parametrize("n", [9, 20, 300])
def test_large_multiples_of_angles_are_expanded(n: int) -> None:
    for wave in (sin(n * x), cos(n * x + a), tan(n * x), sinh(n * x + a), cosh(n * x), tanh(n * x)):
        expanded = expand_trig(wave)
        assert expanded == wave
        assert not expanded.has(n * x)
        assert any(expanded.has(f(x)) for f in (sin, tan, sinh, cosh, tanh))


def test_expanded_waves_are_those_of_sympy() -> None:
    sympy = pytest.importorskip("sympy")
    random = Random(5)
    for function in (sin, cos, tan, sinh, cosh, tanh):
        for _ in range(20):
            angle = sum((random.randint(-4, 4) * s for s in (x, y, z)), number(0))
            wave = function(angle)
            expanded = expand_trig(wave)
            assert expanded == wave
            other = from_sympy(sympy.expand_trig(wave.to_sympy()))
            assert expanded == other
            point = {s: random.uniform(0.1, 0.9) for s in (x, y, z)}
            assert expanded.evaluate(point) == pytest.approx(other.evaluate(point), rel=1e-9)


def test_angles_within_angles_share_the_limit() -> None:
    """Each level has exponentially more terms than the one inside it."""
    nested = x
    for _ in range(3):
        nested = sin(nested * y + 2 * nested * x)
    with pytest.raises(
        ExpressionError, match="terms of an expanded expression: at most 200000, found 200001"
    ):
        expand_trig(nested)


def test_multiples_beyond_the_limit_are_refused() -> None:
    with pytest.raises(
        ExpressionError, match="terms of an expanded expression: at most 200000, found 1000001"
    ):
        expand_trig(cos(10**6 * x))


@pytest.mark.parametrize(
    ("expression", "variable", "n"),
    [
        (3 * y * x**2 + 1, x**2, 1),
        (x**4 + x**3 + 2 * y * x**2, x**2, 2),
        (x**2 + x + 1, x**2, 0),
        (a / x + x, 1 / x, 1),
        (a / x + b + x, x, 0),
        (a * sqrt(x) + x, sqrt(x), 1),
        (a * (x * (b * y)) + x, x * y, 1),
        (3 * x * y**2 + 5 * x * y, x * y, 1),
        (3 * sin(x) ** 2 + 1, sin(x) ** 2, 1),
    ],
    ids=str,
)
def test_coefficients_of_powers_and_products_are_those_of_sympy(
    expression: Expr, variable: Expr, n: int
) -> None:
    assert coeff(expression, variable, n) == from_sympy(to_sympy(expression).coeff(to_sympy(variable), n))
