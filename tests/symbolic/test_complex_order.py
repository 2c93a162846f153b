"""Complex symbols in moduli and in functions that order real numbers."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from symbody import Abs, Expr, Max, Min, Piecewise, atan2, diff, exp, gradient, jacobian, sign, symbols
from symbody.errors import ArgumentError, ExpressionError

x, y = symbols("x y")
s = symbols("s", real=False)

NO_DERIVATIVE = (
    "has no derivative where its argument is complex, and s is declared with real=False; declare s without real=False, "
    "or write the real and the imaginary part as real symbols"
)


@pytest.mark.parametrize(
    ("whole", "variable"),
    [
        (Abs(s), s),
        (Abs(s * x), s),
        (Abs(exp(s * x)) ** 2, s),  # its growth with s is the real number 2*x, but it is no analytic function
        (Abs(s + x), x),
        (sign(s**2 + x), x),
    ],
)
def test_moduli_of_what_is_complex_have_no_derivative(whole: Expr, variable: Expr) -> None:
    for derive in (diff, lambda e, v: gradient(e, [v]), lambda e, v: jacobian([e], [v])):
        with pytest.raises(ExpressionError) as caught:
            derive(whole, variable)
        assert NO_DERIVATIVE in str(caught.value)


def test_what_grows_by_a_real_factor_has_a_derivative_of_its_modulus() -> None:
    assert diff(Abs(s * x), x) == Abs(s * x) / x
    assert gradient(Abs(s * exp(x)), [x, y])[0] == Abs(s * exp(x))
    assert diff(sign(s * x), x) == 0
    assert diff(Abs((s * x + x) / (s + 1)), x) == sign(x)


ORDERS: dict[str, tuple[Callable[[], Expr], str]] = {
    "maximum": (lambda: Max(s, x), "Max needs real numbers, and s may be complex"),
    "minimum": (lambda: Min(x, 2 * s + 1), "Min needs real numbers, and 2*s + 1 may be complex"),
    "direction": (lambda: atan2(s, x), "atan2 needs real numbers, and s may be complex"),
    "condition": (
        lambda: Piecewise((x, s), otherwise=y),
        "the condition of Piecewise needs real numbers, and s may be complex",
    ),
    "substitution": (lambda: Max(x, y).subs({x: s}), "Max needs real numbers, and s may be complex"),
}


@pytest.mark.parametrize("name", ORDERS)
def test_complex_numbers_have_no_order(name: str) -> None:
    make, message = ORDERS[name]
    with pytest.raises(ExpressionError) as caught:
        make()
    remedy = ", because s is declared with real=False; take its modulus, or declare s without real=False"
    assert message + remedy in str(caught.value)


def test_what_does_not_depend_on_complex_symbols_has_an_order() -> None:
    assert Max((s * x + x) / (s + 1), y) == Max(x, y)
    assert Piecewise((s, x), otherwise=0).subs({x: 1}) == s


def test_positive_symbols_are_real() -> None:
    with pytest.raises(ArgumentError) as caught:
        symbols("w", real=False, positive=True)
    assert str(caught.value) == (
        "symbols: positive=True with real=False; positive numbers are real: leave one of them out"
    )
