"""Numerators and denominators, and values by cases: by their values at numbers, and by SymPy."""

from __future__ import annotations

import pytest
import sympy

from symbody.symbolic import Expr, symbol, t
from symbody.worksheet.interpreter.interpret import Interpreter
from tests.worksheet.printed_by import failures


def scalar_of(text: str) -> Expr:
    found = Interpreter().session.parsed(f"{text};")
    assert isinstance(found, Expr)
    return found


@pytest.mark.parametrize(
    "fraction",
    [
        *(
            "a/b + c",
            "s^4 + s^3*(c/a + c/b) + c*s/a/b",
            "1/(1/a + 1/b)",
            "(a/b)^2*c",
            "(a^2-b^2)/(a-b)",
            "-a/b - c/s",
        ),
        *(
            "1/2*a + b/3",
            "(a/2 + b/3)^(-2)",
            "2/(2*a + 4)",
            "1/(1-a) + 1/(a-1)^2",
            "1/(a-b) + 1/(b-a)",
            "-a/(b*(-2))",
        ),
    ],
)
def test_numerator_and_denominator_are_polynomials(fraction: str) -> None:
    above, below = scalar_of(f"numer({fraction})"), scalar_of(f"denom({fraction})")
    p, q = (sympy.sympify(str(each)) for each in (above, below))
    assert p.is_polynomial()
    assert q.is_polynomial()
    expected = sympy.fraction(sympy.cancel(sympy.sympify(fraction.replace("^", "**"))))
    assert sympy.expand(p * expected[1] - q * expected[0]) == 0
    assert sympy.gcd(p, q) == 1


def test_a_root_stands_below() -> None:
    assert scalar_of("denom(sqrt(a)/sqrt(b))") == symbol("b") ** scalar_of("1/2")


@pytest.mark.parametrize(
    ("condition", "holds"),
    [
        ("t < 1", lambda x: x < 1),
        ("t <= 1", lambda x: x <= 1),
        ("t > 0 and t <= 1", lambda x: 0 < x <= 1),
        ("t < 0 or t >= 1", lambda x: x < 0 or x >= 1),
        ("not (t < 0 or t > 1)", lambda x: not (x < 0 or x > 1)),
        ("t = 1", lambda x: x == 1),
        ("t <> 1", lambda x: x != 1),
    ],
)
def test_cases_hold_up_to_their_bounds(condition: str, holds: object) -> None:
    value = scalar_of(f"piecewise(t < -1, 3, {condition}, 5, t < 3, 7, 9)")
    assert callable(holds)
    for x in (-2, 0, 0.5, 1, 2, 4):
        expected = 3 if x < -1 else 5 if holds(x) else 7 if x < 3 else 9
        assert value.evaluate({t: x}) == expected


def test_what_is_no_condition_is_refused() -> None:
    assert failures("piecewise(a, 1, 2);") == [
        "piecewise: the condition a is none of inequalities; expected one such as x < 1"
    ]
