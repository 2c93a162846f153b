"""A derivative with respect to t is the total one or the partial one, and its name says which."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from symbody import (
    Expr,
    Matrix,
    diff,
    function,
    functions_of_time,
    gradient,
    jacobian,
    parse,
    partial_derivative,
    sin,
    solve,
    symbols,
    t,
    time_derivative,
)
from symbody.errors import ArgumentError, ExpressionError
from symbody.symbolic import free_symbols
from tests.repeated import repeated
from tests.symbolic import random_expression

x, y = functions_of_time("x y")
a, b = symbols("a b")
f = function("f")


def test_the_total_derivative_carries_functions_of_time() -> None:
    assert partial_derivative(x * t, t) == x
    for total in (diff(x * t, t), (x * t).diff(t), time_derivative(x * t), parse("diff(x(t)*t, t)")):
        assert total == x + t * time_derivative(x)
    assert Matrix([[x * t]]).diff(t) == Matrix([[diff(x * t, t)]])


def test_entries_and_orders() -> None:
    third = 6 * x + time_derivative(x)
    entries = [x * t**3 + time_derivative(x) * t**3 / 6, f(x, t), a]
    expected = [third, f.derivative([0, 3], x, t), 0]
    assert partial_derivative(entries, t, 3) == expected
    assert partial_derivative(tuple(entries), t, 3) == tuple(expected)
    assert partial_derivative(Matrix([entries]), t, 3) == Matrix([expected])
    assert partial_derivative(np.array([entries]), t, 3).tolist() == [expected]
    assert partial_derivative(x * t, t, 0) == x * t


@pytest.mark.parametrize("seed", [*range(20), *repeated(range(20, 60))])
def test_the_total_derivative_is_a_sum_of_partial_ones(seed: int) -> None:
    expression = random_expression.expression(seed, depth=3)
    total: Expr = partial_derivative(expression, t)
    for leaf in free_symbols([expression]) - {t}:
        if leaf.depends_on_time:
            total += partial_derivative(expression, leaf) * time_derivative(leaf)
    assert total == time_derivative(expression)


@pytest.mark.parametrize("seed", range(30))
def test_mixed_partial_derivatives_commute(seed: int) -> None:
    expression = random_expression.expression(seed, depth=2) * sin(x * t + a)
    variables = [t, x, time_derivative(x), a]
    for u in variables:
        for v in variables:
            one, other = (
                partial_derivative(partial_derivative(expression, first), second)
                for first, second in ((u, v), (v, u))
            )
            assert one == other


def test_other_variables_have_one_derivative() -> None:
    for variable in (x, a, time_derivative(x)):
        assert partial_derivative(a * x * t * time_derivative(x), variable) == diff(
            a * x * t * time_derivative(x), variable
        )


@pytest.mark.parametrize(
    ("place", "work"),
    [
        ("gradient", lambda: gradient(x * t, [a, t])),
        ("gradient", lambda: gradient(x * t, t)),
        ("gradient", lambda: gradient(f(x), t)),
        ("gradient", lambda: gradient(a * time_derivative(x), [t, x])),
        ("jacobian", lambda: jacobian([a, x * t], [a, t])),
        ("jacobian", lambda: jacobian([a, x * t, b], t)),
        ("jacobian", lambda: jacobian(gradient(x**2 * t, [x, a]), [t, x])),
    ],
)
def test_what_is_ambiguous_is_refused(place: str, work: Callable[[], object]) -> None:
    with pytest.raises(ExpressionError, match=f"{place}: .* two derivatives with respect to t") as caught:
        work()
    assert "time_derivative(e)" in str(caught.value)
    assert "partial_derivative(e, t)" in str(caught.value)


def test_what_has_one_meaning_is_allowed() -> None:
    assert gradient(a * t**2 * f(b, t), [a, t]) == (t**2 * f(b, t), diff(a * t**2 * f(b, t), t))
    assert jacobian([sin(a * t)], [t]) == Matrix([[diff(sin(a * t), t)]])
    assert gradient(x * t, [x, a]) == (t, 0)


def test_an_equation_is_solved_for_t_with_coordinates_fixed() -> None:
    assert solve(x * (t + 1) ** 2 - x * t**2 - a, t) == {t: (a - x) / (2 * x)}


def test_what_is_no_variable() -> None:
    with pytest.raises(ExpressionError, match=r"2\*a is not a variable"):
        partial_derivative(a, 2 * a)
    with pytest.raises(ArgumentError, match=r"partial_derivative, expression: 'x' is a str"):
        partial_derivative("x", a)  # type: ignore[call-overload]
    with pytest.raises(ArgumentError, match="partial_derivative: n is -1; expected"):
        partial_derivative([x], t, -1)
