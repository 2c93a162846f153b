"""What is no expression is refused where it comes in, with its place, what was found, and the way out."""

from __future__ import annotations

from collections.abc import Callable
from decimal import Decimal
from typing import Any

import numpy as np
import pytest
import sympy

from symbody import symbolic
from symbody.codegen import lambdify
from symbody.errors import ArgumentError, DivisionByZeroError, ExpressionError, ParameterError, SymbodyError
from symbody.geometry import Vector, ground
from symbody.symbolic import (
    Expr,
    Matrix,
    coeff,
    collect,
    cost,
    diff,
    expand,
    from_sympy,
    function,
    functions_of_time,
    gradient,
    identity,
    jacobian,
    listing,
    log,
    number,
    sin,
    solve,
    sqrt,
    symbols,
    time_derivative,
    to_sympy,
    zeros,
)

x, y, a, b = symbols("x y a b")
q = functions_of_time("q")
f = function("f")
M = Matrix([[a, b], [b, a]])
anything: Any = symbolic  # the functions without their types, as a user of a notebook sees them
NUMBER = "expected an expression or a number (int, float, Fraction, NumPy scalar)"
CONTAINED = (
    "expected an expression, a number (int, float, Fraction, NumPy scalar), or what holds them: a list, a matrix, "
    "a body, equations"
)

MISTAKES: list[tuple[type[SymbodyError], Callable[[], object], str]] = [
    # --- makers of leaves ---
    (
        ArgumentError,
        lambda: anything.symbols("a", positive=1),
        "symbols: positive is 1; expected True or False",
    ),
    (
        ArgumentError,
        lambda: anything.symbols("n", integer=True),
        "symbols: unknown assumption integer; expected positive=True, real=False, or none",
    ),
    (
        ArgumentError,
        lambda: anything.symbols("n", negative=True),
        (
            "symbols: unknown assumption negative; expected positive=True, real=False, or none; a negative "
            "number is -symbols('a', positive=True)"
        ),
    ),
    (
        ArgumentError,
        lambda: anything.functions_of_time("l", positive=True),
        (
            "functions_of_time: unknown assumption positive; functions of time are real and have no other "
            "assumptions: leave it out"
        ),
    ),
    (
        ArgumentError,
        lambda: anything.symbols(3),
        "symbols: 3 is an int; expected names in a text, such as 'm g l1'",
    ),
    (
        ArgumentError,
        lambda: anything.functions_of_time(["x", None]),
        "functions_of_time: None; expected names in a text, such as 'm g l1'",
    ),
    (ExpressionError, lambda: function("f g"), "function: 2 names in 'f g'; expected one, such as 'f'"),
    (
        ArgumentError,
        lambda: f.derivative([-1], x),
        "f.derivative: an order is -1; expected 0, 1, 2, ... derivatives",
    ),
    (
        ExpressionError,
        lambda: f.derivative([1, 1], x),
        "f.derivative: 2 orders for 1 argument; expected one for each",
    ),
    # --- numbers ---
    (ArgumentError, lambda: anything.number(1j), f"number: 1j is a complex; {NUMBER}"),
    (
        ExpressionError,
        lambda: anything.number(Decimal("nan")),
        "NaN is not a finite number; expressions hold finite numbers only",
    ),
    (
        ExpressionError,
        lambda: x * float("nan"),
        "NaN is not a finite number; expressions hold finite numbers only",
    ),
    (
        ExpressionError,
        lambda: np.float32(np.inf) - x,
        "inf is not a finite number; expressions hold finite numbers only",
    ),
    # --- functions and operators ---
    (ArgumentError, lambda: anything.sin("x"), f"sin: 'x' is a str; {NUMBER}; parse converts it"),
    (ArgumentError, lambda: anything.sqrt(None), f"sqrt: None; {NUMBER}"),
    (ArgumentError, lambda: sin(True), f"sin: True is a bool; {NUMBER}"),
    (ArgumentError, lambda: anything.sin(f), f"sin: {f!r} is an UndefinedFunction; {NUMBER}"),
    (
        ArgumentError,
        lambda: anything.sin(sympy.Symbol("x")),
        f"sin: x is a Symbol; {NUMBER}; from_sympy converts it",
    ),
    (
        ArgumentError,
        lambda: x + sympy.Symbol("y"),
        "arithmetic with expressions: y is a Symbol; expected an expression or a number; from_sympy converts it",
    ),
    (
        ArgumentError,
        lambda: anything.Piecewise(x),
        "a branch of Piecewise is a pair (value, condition > 0), found x",
    ),
    (
        ArgumentError,
        lambda: anything.Piecewise((x, "y")),
        f"Piecewise: 'y' is a str; {NUMBER}; parse converts it",
    ),
    (
        ExpressionError,
        lambda: log(0),
        "log is not defined at 0; check the argument, or keep a symbol there and give its value later",
    ),
    (
        DivisionByZeroError,
        lambda: x / (a - a),
        (
            "x is divided by an expression that is identically zero; "
            "check the divisor: its terms cancel, or a substitution makes it zero"
        ),
    ),
    (
        ArgumentError,
        lambda: pow(x, 2, 3),
        "pow takes an expression and an exponent, but no modulus",
    ),
    (ArgumentError, lambda: int(sqrt(a)), "int: sqrt(a) is not an integer"),
    # --- derivatives and substitution ---
    (ArgumentError, lambda: x.diff(x, -1), "diff: n is -1; expected 0, 1, 2, ... derivatives"),
    (ArgumentError, lambda: anything.diff(x, x, 1.5), "diff: n is 1.5; expected 0, 1, 2, ... derivatives"),
    (
        ArgumentError,
        lambda: anything.diff("x", x),
        f"diff, expression: 'x' is a str; {NUMBER}; parse converts it",
    ),
    (ArgumentError, lambda: anything.diff(x, [x]), f"diff, variable: [x] is a list; {NUMBER}"),
    (
        ExpressionError,
        lambda: diff(x, number(2)),
        "2 is not a variable; use a symbol, a function of time or one of its derivatives",
    ),
    (
        ArgumentError,
        lambda: time_derivative(q, -1),
        "time_derivative: n is -1; expected 0, 1, 2, ... derivatives",
    ),
    (
        ArgumentError,
        lambda: anything.gradient(x, "x"),
        "gradient, variables: 'x' is a str; expected a list of expressions; parse converts it",
    ),
    (
        ArgumentError,
        lambda: anything.jacobian(3, [x]),
        "jacobian, expressions: 3 is an int; expected a list of expressions",
    ),
    (
        ArgumentError,
        lambda: anything.subs(x, 3),
        "subs: 3 is an int; expected a mapping of expressions to expressions, such as {x: 1}",
    ),
    (ArgumentError, lambda: anything.subs(x, {"x": 1}), f"subs: 'x' is a str; {NUMBER}; parse converts it"),
    (
        ArgumentError,
        lambda: anything.subs(x, {x: None}),
        f"subs: the replacement of x: None; {NUMBER}",
    ),
    (
        ArgumentError,
        lambda: x.evaluate({x: "1"}),
        "evaluate: the value of x: '1' is a str; expected a number; parse converts it",
    ),
    (
        ArgumentError,
        lambda: x.evaluate(3),
        "evaluate: 3 is an int; expected a mapping of variables to numbers, such as {x: 1.0}",
    ),
    # --- rewrites, equations, counts, texts ---
    (ArgumentError, lambda: anything.expand("x"), f"expand: 'x' is a str; {CONTAINED}; parse converts it"),
    (ArgumentError, lambda: anything.simplify({3}), f"simplify: {{3}} is a set; {CONTAINED}"),
    (
        ArgumentError,
        lambda: anything.collect(x, 3),
        "collect, variables: 3 is an int; expected a list of expressions",
    ),
    (
        ArgumentError,
        lambda: anything.coeff(x, 2),
        "coeff, variable: 2 is a number; expected a symbol, or a function, such as x",
    ),
    (ArgumentError, lambda: anything.coeff(x, x, 1.5), "coeff, n: 1.5 is a float; expected a whole number"),
    (
        ArgumentError,
        lambda: anything.solve(3, x),
        "solve, equations: 3 is an int; expected a list of expressions",
    ),
    (
        ArgumentError,
        lambda: cost({"a": x}),
        "cost counts expressions, found the text 'a'; parse it first",
    ),
    (ArgumentError, lambda: anything.latex({x}), f"latex: {{x}} is a set; {CONTAINED}"),
    (
        ArgumentError,
        lambda: anything.latex([x, (1, "y")]),
        f"latex, entry [1][1]: 'y' is a str; {NUMBER}; parse converts it",
    ),
    (
        ArgumentError,
        lambda: anything.simplify({"a": [x, "y"]}),
        f"simplify, entry ['a'][1]: 'y' is a str; {NUMBER}; parse converts it",
    ),
    (ArgumentError, lambda: anything.maple(M), f"maple: {M!r} is a Matrix; {NUMBER}"),
    (
        ArgumentError,
        lambda: listing([x], "pdf"),
        "listing: pdf is not a notation; expected text, latex or maple",
    ),
    (ArgumentError, lambda: anything.parse(3), "parse: 3 is an int; expected a text, such as 'm*x + k*x'"),
    (
        ArgumentError,
        lambda: anything.parse("a + 1", {"a": "b"}),
        f"parse, the meaning of a: 'b' is a str; {NUMBER}; parse converts it",
    ),
    # --- matrices ---
    (
        ArgumentError,
        lambda: anything.Matrix(3),
        "Matrix: 3 is an int; expected a list of rows, as in Matrix([[a, b], [c, d]])",
    ),
    (
        ArgumentError,
        lambda: anything.Matrix([1, 2]),
        (
            "Matrix, row 1: 1 is an int; expected a list of entries. "
            "One column is Matrix.column([a, b]), one row Matrix([[a, b]])"
        ),
    ),
    (
        ArgumentError,
        lambda: anything.Matrix([[x, "y"]]),
        f"Matrix, row 1, column 2: 'y' is a str; {NUMBER}; parse converts it",
    ),
    (ExpressionError, lambda: M[2, 0], "the index 2 of a matrix of 2 rows; the first has the index 0"),
    (
        ArgumentError,
        lambda: M[0, "a"],  # type: ignore[index]
        "the index 'a' of a matrix; expected whole numbers or slices",
    ),
    (
        ArgumentError,
        lambda: anything.Matrix([[x]]) * "y",
        f"Matrix * factor: 'y' is a str; {NUMBER}; parse converts it",
    ),
    (ArgumentError, lambda: M.diff(a, -1), "Matrix.diff: n is -1; expected 0, 1, 2, ... derivatives"),
    (ArgumentError, lambda: identity(-1), "identity: n is -1; expected 0, 1, 2, ... rows"),
    (ArgumentError, lambda: zeros(-1, 2), "zeros: rows is -1; expected 0, 1, 2, ... rows"),
    # --- compiled functions ---
    (
        ArgumentError,
        lambda: lambdify("x", x),  # type: ignore[arg-type]
        "lambdify, arguments: 'x' is a str; expected a list of variables",
    ),
    (
        ArgumentError,
        lambda: lambdify([x + 1], x),
        (
            "lambdify, arguments: x + 1 is not a variable; "
            "expected symbols, functions of time, their derivatives, or lists of these"
        ),
    ),
    (
        ArgumentError,
        lambda: lambdify(x, {"a": x}),
        f"lambdify, expressions: {{'a': x}} is a dict; {NUMBER}",
    ),
    (
        ArgumentError,
        lambda: lambdify(x, "x"),
        f"lambdify, expressions: 'x' is a str; {NUMBER}; parse converts it",
    ),
    (ArgumentError, lambda: lambdify(x, x)([1, None]), "the argument x takes real numbers, found [1, None]"),  # type: ignore[arg-type]
    (ArgumentError, lambda: lambdify(x, x)(1j), "the argument x takes real numbers, found 1j"),
    (
        ParameterError,
        lambda: lambdify(x, x)(10**400),
        "the argument x takes doubles; found a number beyond the largest of them, 1.8e308",
    ),
    (ArgumentError, lambda: lambdify([[x, y]], x)("a"), "the argument [x, y] takes real numbers, found 'a'"),
    (
        ParameterError,
        lambda: lambdify([x, y], x + y)([1, 2], [1, 2, 3]),
        (
            "the arguments have values of the shapes (2,), (3,), which don't broadcast; "
            "expected the same number of points for each"
        ),
    ),
    # --- SymPy ---
    (
        ArgumentError,
        lambda: from_sympy(None),
        "from_sympy: None; expected an expression or a matrix of SymPy, or a list of them",
    ),
    (ArgumentError, lambda: from_sympy("x"), "from_sympy: 'x' is a str; parse converts it"),
    (
        ExpressionError,
        lambda: from_sympy(sympy.Integral(sympy.Symbol("x"))),
        (
            "SymPy's Integral has no counterpart here: Integral(x, x); let SymPy evaluate it first, by doit(); an "
            "integral over time may be a coordinate, with its integrand as the rate"
        ),
    ),
    (
        ExpressionError,
        lambda: from_sympy(sympy.Symbol("x'") + 1),
        (
            'from_sympy: "x\'" is not a name; expected letters, digits and underscores, not starting with a digit; '
            "give its meaning, as in names={\"x'\": symbols('a')}"
        ),
    ),
    (
        ExpressionError,
        lambda: from_sympy(sympy.Symbol("pi")),
        (
            "from_sympy: the name 'pi' stands for the circle constant, symbody.pi; choose another name; "
            "give its meaning, as in names={'pi': symbols('a')}"
        ),
    ),
    (ArgumentError, lambda: anything.to_sympy([None]), f"to_sympy: None; {NUMBER}"),
]


@pytest.mark.parametrize(("error", "mistake", "message"), MISTAKES, ids=[row[2][:50] for row in MISTAKES])
def test_a_mistake_has_its_message(
    error: type[SymbodyError], mistake: Callable[[], object], message: str
) -> None:
    with pytest.raises(error) as caught:
        mistake()
    assert str(caught.value) == message
    assert type(caught.value) is error


def test_a_wrong_argument_is_a_type_error_too() -> None:
    with pytest.raises(TypeError):
        expand("x")  # type: ignore[arg-type]


@pytest.mark.parametrize("other", ["a", None, [1], 1j, True])
def test_python_refuses_operators_with_what_is_no_number(other: Any) -> None:
    with pytest.raises(TypeError, match="unsupported operand"):
        x + other


def test_vectors_and_matrices_take_over_the_product() -> None:
    vector = Vector(ground, 1, 2, 3)
    assert x * M == M * x
    assert (x * vector).components == (x, 2 * x, 3 * x)
    assert (x == M) is False


def test_one_expression_is_a_list_of_one() -> None:
    assert solve(2 * x - a, x) == {x: a / 2}
    assert gradient(x * y, x) == (y,)
    assert jacobian(x * y, x) == Matrix([[y]])
    assert collect(a * x + b * x, x).same_form(x * (a + b))
    assert coeff(a * x, x) == a


def test_what_has_a_plain_meaning_is_taken() -> None:
    made = to_sympy(Matrix([[x, 2]]))
    assert made == sympy.Matrix([[sympy.Symbol("x", real=True), 2]])
    assert to_sympy(3) == 3
    assert from_sympy(sympy.Symbol("a b"), names={"a b": a}) == a
    assert anything.Matrix(np.eye(2)) == identity(2)
    assert lambdify(x, np.array([[x, 2 * x], [3 * x, 0]]))(2.0).tolist() == [[2, 4], [6, 0]]
    assert [row.tolist() for row in lambdify(x, [[x, 2 * x], [3 * x, 0]])(2.0)] == [[2, 4], [6, 0]]


def test_free_symbols_are_leaves() -> None:
    assert f(q, a).free_symbols == {q, a}
    assert (f(q) + x).diff(q).free_symbols == {q}


def test_one_expression_is_listed_alone() -> None:
    assert listing(x) == listing([x])


def test_an_expression_too_deep_for_sympy_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    def recurse(*_: Expr) -> None:
        raise RecursionError

    monkeypatch.setattr(sympy, "Add", recurse)
    with pytest.raises(ExpressionError, match="to_sympy: the expression is nested deeper than SymPy"):
        to_sympy(x + 1)
