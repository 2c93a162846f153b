"""What is printed parses back, and what doesn't parse says where and why."""

from __future__ import annotations

from random import Random

import pytest

from symbody.errors import DivisionByZeroError, ExpressionError, ParseError
from symbody.symbolic import (
    Abs,
    Min,
    Piecewise,
    atan2,
    function,
    functions_of_time,
    number,
    pi,
    sin,
    sqrt,
    symbols,
    t,
    time_derivative,
)
from symbody.symbolic.text.parse import parse
from tests.repeated import repeated
from tests.symbolic.random_expression import NAMES, doubling, expression

a, b, c = symbols("a b c")
x, y = functions_of_time("x y")
f = function("f")


@pytest.mark.parametrize("seed", [*range(100), *repeated(range(100, 300))])
def test_printed_text_parses_back(seed: int) -> None:
    e = expression(seed)
    assert parse(str(e), NAMES) == e


@pytest.mark.parametrize("seed", range(20))
def test_doubles_parse_back(seed: int) -> None:
    random = Random(seed)
    for _ in range(20):
        value = random.uniform(-10, 10) * 10 ** random.randint(-300, 300)
        assert parse(str(value * a + value), {"a": a}) == value * a + value


@pytest.mark.parametrize("seed", [*range(40), *repeated(range(40, 100))])
def test_decimals_over_integers_parse_back(seed: int) -> None:
    """A decimal whose digits do not end stands over an integer, as in ``0.1*a/7``."""
    random = Random(seed)
    decimal = number(random.choice([0.1, 1.5, 0.25, 9.81, 2e-5]))
    integer = random.choice([3, 7, 9, 12, 30, 77, 210])
    for quotient in (
        decimal / integer,
        integer / decimal,
        -decimal * a / integer,
        sin(a * decimal / integer),
    ):
        assert parse(str(quotient + x), {"x": x}) == quotient + x
        assert "33333333" not in str(quotient)


def test_short_names_of_equations_are_read() -> None:
    """As `show` prints them: names with ``:=`` before an equation, also of several lines."""
    found = parse("    c1 := cos(x)\n    M12 := a*c1\n        + b*c1**2\n    M12*x'' - c1", {"a": a})
    assert found == parse("(a*cos(x) + b*cos(x)**2)*x'' - cos(x)")


def test_a_large_expression_parses_back() -> None:
    e = doubling(80)
    assert parse(str(e)) == e


def test_a_long_sum_parses_back() -> None:
    terms = symbols(" ".join(f"a{i}" for i in range(1500)))
    total = sum(terms[1:], terms[0])
    assert str(total).startswith("a0 + a1 + a2 + ")
    assert parse(str(total)) == total


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("-a**2", -(a**2)),
        ("a**-2", 1 / a**2),
        ("a^b^c", a ** (b**c)),
        ("a - b - c", a - (b + c)),
        ("a/b/c", a / (b * c)),
        ("a/b*c", a * c / b),
        ("2*-a", -2 * a),
        ("  a\n + b\t", a + b),
        ("1/3", number(1) / 3),
        (".5 + 1.e1 + 2E-1", number(10.7)),
        ("0.1 + 0.2", number(0.3)),
        ("x' + x", time_derivative(x) + x),
        ("x'' + x(t)", time_derivative(x, 2) + x),
        ("x'(t) + x(t)", time_derivative(x) + x),
        ("diff(x, t, 4) + x", time_derivative(x, 4) + x),
        ("diff(x(t), t, t)", time_derivative(x, 2)),
        ("diff(a**3*b, a, 2, b)", 6 * a),
        ("D[1,2,2](f)(a, b)", f.derivative([1, 2], a, b)),
        ("f''(a)", f.derivative([2], a)),
        ("D*D", symbols("D") ** 2),
        ("Piecewise((a, b > c), (b, a < 1), (c, True))", Piecewise((a, b - c), (b, 1 - a), otherwise=c)),
        ("Piecewise((a, b > 0))", Piecewise((a, b))),
        ("abs(a) + min(a, b) + atan2(a, b)", Abs(a) + Min(a, b) + atan2(a, b)),
        ("sqrt(2)*sin(pi/4)*t", sqrt(2) * sin(pi / 4) * t),
        ("z1 = a + b\nz2 = z1**2\nz1*z2", (a + b) ** 3),
        ("z1 = a\n-z1", -a),
    ],
)
def test_notation(text: str, expected: object) -> None:
    assert parse(text) == expected


def test_names_have_the_meaning_that_is_given() -> None:
    p = symbols("p", positive=True)
    assert parse("sqrt(p**2)", {"p": p}) == p
    assert parse("q' + q", {"q": x * a}) == time_derivative(x) * a + x * a
    assert parse("k(a)", {"k": f}) == f(a)
    assert parse("x(t) + x", {"x": x}) == 2 * x
    assert parse("g*a", {"g": 9.81}) == 9.81 * a
    assert parse("t", {"t": a}) == a


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("a + (b*)", "line 1, column 8: found ')', expected a number, a name or '('\n  a + (b*)\n         ^"),
        (
            "2 a",
            "line 1, column 3: found 'a', expected an operator or the end; a product is written with *\n  2 a\n    ^",
        ),
        ("sin(a", "line 1, column 6: the text ends here, expected ')' or ','\n  sin(a\n       ^"),
        ("", "line 1, column 1: the text ends here, expected a number, a name or '('\n  \n  ^"),
        ("a $ b", "line 1, column 3: '$' means nothing here\n  a $ b\n    ^"),
        (
            "a == b",
            "line 1, column 3: '=' means nothing here; an equation is written left - right\n  a == b\n    ^",
        ),
        ("a +\n b*/c", "line 2, column 4: found '/', expected a number, a name or '('\n   b*/c\n     ^"),
        (
            "z = a +\nz",
            "line 1, column 8: the text ends here, expected a number, a name or '('\n  z = a +\n         ^",
        ),
        (
            "z = a",
            "line 1, column 6: found definitions only, expected an expression after them\n  z = a\n       ^",
        ),
        ("D[2](f)(a)", "line 1, column 3: f has no argument 2; it has 1 here\n  D[2](f)(a)\n    ^"),
        (
            "a + f'(b, c)",
            "line 1, column 6: a prime needs a function of one argument; write D[1](f)(...)\n  a + f'(b, c)\n       ^",
        ),
        (
            "diff(a)",
            "line 1, column 1: diff needs an expression and a variable, as in diff(x**2, x)\n  diff(a)\n  ^",
        ),
    ],
)
def test_mistakes_show_their_place(text: str, message: str) -> None:
    with pytest.raises(ParseError) as caught:
        parse(text)
    assert str(caught.value) == message


def test_names_used_against_their_meaning() -> None:
    with pytest.raises(
        ParseError, match=r"column 5: m doesn't depend on time; m' is the derivative of nothing"
    ):
        parse("a + m'", {"m": a})
    with pytest.raises(ParseError, match=r"column 1: f is a function; it needs arguments, as in f\(x\)"):
        parse("f + 1", {"f": f})
    with pytest.raises(
        ParseError, match=r"column 3: a is not a function; a product is written a\*\(\.\.\.\)"
    ):
        parse("2*a(b)", {"a": a})
    with pytest.raises(ParseError, match=r"column 6: a is not an undefined function"):
        parse("D[1](a)(b)", {"a": a})


def test_mathematics_that_fails_says_so() -> None:
    with pytest.raises(DivisionByZeroError, match="identically zero"):
        parse("1/(a - a)")
    with pytest.raises(ExpressionError, match="sin takes 1 argument, found 2"):
        parse("sin(a, b)")


def test_long_integers_parse_back() -> None:
    long = number(10) ** 4400 * symbols("k") + number(7) ** 6000
    assert parse(str(long)) == long
