"""Time derivatives of lists and matrices are those of their entries."""

import numpy as np
import pytest
import sympy

from symbody import Matrix, from_sympy, functions_of_time, symbols, time_derivative, to_sympy
from symbody.errors import ArgumentError

x, y = functions_of_time("x y")
a = symbols("a")
T = sympy.Symbol("t")


@pytest.mark.parametrize("n", [0, 1, 3])
def test_entries(n: int) -> None:
    each = [time_derivative(e, n) for e in (x, a * x * y, a)]
    assert time_derivative([x, a * x * y, a], n) == each
    assert time_derivative((x, a * x * y, a), n) == tuple(each)
    assert time_derivative([(x,), [a * x * y]], n) == [(each[0],), [each[1]]]
    found = time_derivative(Matrix([[x, a * x * y, a]]), n)
    assert found == Matrix([each])
    by_sympy = [from_sympy(to_sympy(e).diff(T, n)) for e in (x, a * x * y, a)]
    assert by_sympy == each
    assert time_derivative([], n) == []
    column = time_derivative(np.array([[x], [a * x * y]]), n)
    assert column.shape == (2, 1)
    assert column.tolist() == [[each[0]], [each[1]]]


def test_what_is_no_expression() -> None:
    with pytest.raises(
        ArgumentError, match=r"time_derivative, expression: 'x' is a str; .*; parse converts it"
    ):
        time_derivative("x")  # type: ignore[call-overload]
    with pytest.raises(ArgumentError, match="time_derivative: n is -1; expected"):
        time_derivative([x], -1)
