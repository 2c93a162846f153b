"""Mistakes with expressions, small variables and derivatives: their whole messages."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from symbody import SymbodyError, errors, functions_of_time, gradient, small, sqrt, symbols, t, taylor
from tests.errors.given import Mistake, a, check, m, tilt, x

MISTAKES: list[Mistake] = [
    (errors.ArgumentError, small, "small: no variables; give some, such as small(x, psi)"),
    (
        errors.ArgumentError,
        lambda: small([x]),
        (
            "small: [x] is a list; expected symbols and functions of time, one by one: "
            "small(*functions_of_time('x psi'))"
        ),
    ),
    (
        errors.ArgumentError,
        lambda: small(x + 1),
        ("small: x + 1 is not a symbol or a function of time; write 1 + x for a value near 1, with x small"),
    ),
    (
        errors.ArgumentError,
        lambda: small(symbols("length", positive=True)),
        (
            "small: length is assumed to be positive, and small variables are real, of either sign; "
            "use symbols without assumptions"
        ),
    ),
    (
        errors.ArgumentError,
        lambda: functions_of_time("x", small=True),
        "functions_of_time: small is a function, not an option; expected small(*functions_of_time('x'))",
    ),
    (
        errors.ExpressionError,
        lambda: taylor(sqrt(tilt)),
        (
            "sqrt(tilt) has no expansion in small tilt: it is singular, or 0/0, where small variables are zero; "
            "expand it at a regular value (1 + x for a variable near 1), or leave tilt out of the small variables"
        ),
    ),
    (
        errors.ArgumentError,
        lambda: taylor(x, [x + 1]),
        "taylor: x + 1 is not a variable; expand in symbols or functions of time",
    ),
    (errors.ArgumentError, lambda: taylor(x, {x: x + 1}), "taylor: the value x + 1 of x contains x itself"),
    (
        errors.ArgumentError,
        lambda: taylor(x, [x], -1),
        "taylor: the order is -1; expected 0, 1, 2, ... degrees",
    ),
    (errors.ExpressionError, lambda: taylor(x, [x], 21), "degree of an expansion: at most 20, found 21"),
    (
        errors.ArgumentError,
        lambda: taylor(x, "x"),  # type: ignore[arg-type]
        "taylor: 'x' is a str; expected variables, such as [x, y], or values: {x: 1}",
    ),
    (
        errors.DivisionByZeroError,
        lambda: a / (x - x),
        (
            "a is divided by an expression that is identically zero; check the divisor: its terms cancel, or a "
            "substitution makes it zero"
        ),
    ),
    (
        errors.ExpressionError,
        lambda: gradient(x * t, [m, t]),
        (
            "gradient: t*x contains the function of time x, so it has two derivatives with respect to t: "
            "time_derivative(e) is the total one, partial_derivative(e, t) the one that holds x fixed"
        ),
    ),
]


@pytest.mark.parametrize(("kind", "mistake", "message"), MISTAKES)
def test_message(kind: type[SymbodyError], mistake: Callable[[], object], message: str) -> None:
    check(kind, mistake, message)
