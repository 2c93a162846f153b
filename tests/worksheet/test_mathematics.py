"""Transforms, eigenvalues, roots and complex numbers, compared with SciPy, NumPy and Python's own."""

from __future__ import annotations

import cmath
import math

import numpy as np
import pytest
from scipy.integrate import quad

from symbody.symbolic import Expr, pi, symbol, t
from symbody.symbolic.calculus.reading import nodes_of
from symbody.worksheet.interpreter.interpret import Interpreter
from symbody.worksheet.values.value import Array
from tests.worksheet.printed_by import failures, printed


def scalar_of(text: str) -> Expr:
    """Return the scalar that the last expression of a sheet gives."""
    interpreter = Interpreter()
    *before, last = text.split(":")
    printed(":".join([*before, ""]), None, interpreter)
    found = interpreter.session.parsed(f"{last};")
    assert isinstance(found, Expr)
    return found


@pytest.mark.parametrize("function", ["1", "t^2", "exp(-2*t)", "sin(3*t)", "t*cos(2*t)", "exp(-t)*sin(2*t)"])
def test_laplace_transforms_are_integrals(function: str) -> None:
    original = scalar_of(function)
    transform = scalar_of(f"with(inttrans): laplace({function}, t, s)")
    s = 1.7
    expected, _ = quad(lambda at: original.evaluate({t: at}) * math.exp(-s * at), 0, 60, limit=400)
    assert transform.evaluate({symbol("s"): s}) == pytest.approx(expected, rel=1e-7)


@pytest.mark.parametrize("transform", ["1/(s+2)", "3/(s^2+9)", "s/(2*s^2+4*s+10)", "5/(3*s*(s+1)^2)", "0"])
def test_the_inverse_transform_is_transformed_back(transform: str) -> None:
    assert scalar_of(f"with(inttrans): laplace(invlaplace({transform}, s, t), t, s) - ({transform})").is_zero


def test_eigenvalues_are_those_of_numpy() -> None:
    found = Interpreter().session.parsed(
        "LinearAlgebra[Eigenvalues](Matrix([[2., 1., 0.], [1., 3., 1.], [0., 1., 4.]]));"
    )
    assert isinstance(found, Array)
    values = sorted(each.evaluate({}) for each in found.entries if isinstance(each, Expr))
    assert values == pytest.approx(np.linalg.eigvalsh([[2, 1, 0], [1, 3, 1], [0, 1, 4]]), rel=1e-9)


def test_roots_without_a_closed_form_are_those_of_numpy() -> None:
    lines = printed("evalf(solve(x^5 - x - 1 = 0, x));")
    (real,) = (each.real for each in np.roots([1, 0, 0, 0, -1, -1]) if abs(each.imag) < 1e-12)
    assert f"{real:.9f}" in lines[0]


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("Re((2+3*I)*(1-I))", ((2 + 3j) * (1 - 1j)).real),
        ("Im((2+3*I)/(1-I))", ((2 + 3j) / (1 - 1j)).imag),
        ("abs(3-4*I)", abs(3 - 4j)),
        ("Im(exp(1+2*I))", cmath.exp(1 + 2j).imag),
        ("Re(conjugate(5+2*I))", 5),
        ("argument(-1+I)", cmath.phase(-1 + 1j)),
    ],
)
def test_complex_numbers_are_those_of_python(text: str, value: float) -> None:
    assert scalar_of(text).evaluate({}) == pytest.approx(value, rel=1e-12)


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("int(x*exp(-x), x = 0..1)", quad(lambda x: x * math.exp(-x), 0, 1)[0]),
        ("int(int(x*y^2, x = 0..1), y = 0..2)", 4 / 3),
        ("limit((1 - cos(x))/x^2, x = 0)", 1 / 2),
        ("value(Int(sin(x), x = 0..Pi))", 2),
        ("evalf(3*Int(exp(-x^2), x = 0..1) + 1, 15)", 3 * quad(lambda x: math.exp(-(x**2)), 0, 1)[0] + 1),
    ],
)
def test_integrals_and_limits(text: str, value: float) -> None:
    pytest.importorskip("sympy")
    assert scalar_of(text).evaluate({}) == pytest.approx(value, rel=1e-10)


def test_the_last_exception_is_kept() -> None:
    assert printed('try error "too short" catch: print(lastexception) end try:') == ['unknown, "too short"']
    sheet = "r := traperror([1, 2][3]): evalb(r = lasterror), type(r, string); traperror(2 + 2), lasterror;"
    assert printed(sheet) == ["true, true", "4, lasterror"]


@pytest.mark.parametrize(
    ("sheet", "expected"),
    [
        ("evalf(Pi, 15); evalf(Pi);", ["3.14159265358979", "3.141592654"]),
        ("12345678901.5; 1.23456789012345;", ["12345678901.5", "1.23456789012345"]),
        ("Digits := 15: sqrt(2.0); sin(1.0);", ["1.4142135623731", ".841470984807897"]),
        (
            "maximize(a*x-x^2, x); maximize(x^2-b, x=-1..2); maximize(b*x, x=0..1);",
            ["1/4*a^2", "4-b", "maximize(b*x,x = 0 .. 1)"],
        ),
        ("minimize(x^2-2*x, x=0..3, location);", ["-1, {[{x = 1}, -1]}"]),
        (
            "s := series(exp(x), x, 3): 2*s; s + series(sin(x), x, 5);",
            ["2+2*x+x^2+O(x^3)", "1+2*x+1/2*x^2+O(x^3)"],
        ),
        (
            "convert(exp(x),trig); convert([sec(x),cot(x)],sincos);",
            ["cosh(x)+sinh(x)", "[1/cos(x), cos(x)/sin(x)]"],
        ),
        (
            "convert(1/(x^2-1), parfrac, x); convert((2*a+x)/(x^2+a*x), parfrac, x);",
            ["1/2/(x-1)-1/2/(x+1)", "2/x-1/(a+x)"],
        ),
        (
            (
                "simplify(sqrt(x^2*y), symbolic); simplify(sqrt(l^2-l^2*sin(q)^2), symbolic); simplify(sqrt(x^2*y));"
                "simplify((x^4)^(1/4), assume=positive); simplify(arcsin(sin(x))+abs(y), symbolic);"
            ),
            ["x*y^(1/2)", "l*cos(q)", "(x^2*y)^(1/2)", "x", "x+y"],
        ),
        (
            "fnormal([1.00004, 2e-9 + x, 1e-15*x + y], 5); fnormal(0.001, 10, 0.01);",
            ["[1., x, y]", "0"],
        ),
        ("series(1/x+x, x, 3); series(tan(x)/x, x, 4);", ["x+1/x", "1+1/3*x^2+O(x^4)"]),
    ],
)
def test_digits_extrema_and_series(sheet: str, expected: list[str]) -> None:
    pytest.importorskip("sympy")
    assert printed(sheet) == expected


def test_inverse_functions_of_exact_numbers_are_angles() -> None:
    for text, angle in (
        ("arctan(sqrt(3))", math.atan(math.sqrt(3))),
        ("arctan(-1/sqrt(3))", -math.pi / 6),
        ("arctan(1-sqrt(2)/2, -sqrt(2)/2)", None),
        ("arctan(-1, sqrt(3))", math.atan2(-1, math.sqrt(3))),
        ("arctan(2-sqrt(3))", math.pi / 12),
        ("arcsin(-sqrt(3)/2)", math.asin(-math.sqrt(3) / 2)),
        ("arccos(-sqrt(2)/2)", math.acos(-math.sqrt(2) / 2)),
        ("arccos((sqrt(6)-sqrt(2))/4)", 5 * math.pi / 12),
        ("arcsin(43/50)", None),
        ("arcsin(1/2+1/10^12)", None),
        ("arctan(1, 1+1/10^12)", None),
    ):
        found = scalar_of(text)
        assert (found / pi).is_number == (angle is not None), text
        assert angle is None or found.evaluate({}) == pytest.approx(angle, rel=1e-15)


@pytest.mark.parametrize("function", ["sin", "cos", "tan"])
@pytest.mark.parametrize("inverse", ["arcsin", "arccos", "arctan"])
def test_functions_of_inverse_functions_are_algebraic(function: str, inverse: str) -> None:
    called = scalar_of(f"{function}({inverse}(u/3))")
    put_in = scalar_of(f"subs(phi(t) = {inverse}(u/3), {function}(phi(t)))")
    assert put_in == called
    assert not {"asin", "acos", "atan", function} & {
        node.name for node in nodes_of(put_in) if node.kind == "function"
    }
    value = getattr(math, function)(getattr(math, inverse.replace("arc", "a"))(0.7 / 3))
    assert put_in.evaluate({symbol("u"): 0.7}) == pytest.approx(value, rel=1e-14)


@pytest.mark.parametrize(
    ("matrix", "second"),
    [
        ("[[2, 1], [1, 2]]", "[[1, 0], [0, 1]]"),
        ("[[0, 1], [-6, -5]]", "[[1, 0], [0, 1]]"),
        ("[[5, -2, 0], [-2, 3, -1], [0, -1, 1]]", "[[2, 0, 0], [0, 1, 0], [0, 0, 3]]"),
        ("[[1, 1], [0, 1]]", "[[1, 0], [0, 1]]"),
        ("[[0, 1], [-k, -c]]", "[[1, 0], [0, 1]]"),
    ],
)
def test_eigenvectors_in_closed_form_are_eigenvectors(matrix: str, second: str) -> None:
    text = (
        f"A := Matrix({matrix}): C := Matrix({second}): s, V := LinearAlgebra[Eigenvectors](A, C): "
        "simplify(evalf(A . V - C . V . LinearAlgebra[DiagonalMatrix](convert(s, list)), 12)): "
        "convert(map(e -> signum(round(abs(subs(k = 3., c = 9., e))*10^8)), %), set); nops({seq(s[i], i=1..2)});"
    )
    lines = printed(text)
    assert lines[0] == "{0}"
    assert lines[1] == ("1" if matrix == "[[1, 1], [0, 1]]" else "2")


def test_eigenvectors_of_the_old_kind_come_with_their_multiplicity() -> None:
    assert printed(
        "linalg[eigenvects](matrix(2,2,[2,1,1,2])); linalg[eigenvects](matrix(2,2,[1,1,0,1]));"
    ) == [
        "[1, 1, {vector([-1, 1])}], [3, 1, {vector([1, 1])}]",
        "[1, 2, {vector([1, 0])}]",
    ]


def test_complex_eigenvectors_need_numbers() -> None:
    (found,) = failures("LinearAlgebra[Eigenvectors](Matrix([[0, 1], [-1, 0]]));")
    assert (
        "Eigenvectors: eigenvalues that are complex or have no closed form, of a matrix without decimals; "
        "expected numbers, such as evalf(A)"
    ) in found


def test_integrals_of_functions_and_over_areas() -> None:
    text = (
        "p := proc(x) if x < 0.5 then x else 1-x end if end: evalf(Int(p, 0..1)); int(x -> x^2, 0..2); int(p, 0..1); "
        "evalf(Int(cos, 0..1)); evalf(Int(x*y, [x=0..y, y=0..1])); evalf(Int(Int(x*y, x=0..y), y=0..1)); "
        "evalf(Int(exp(-x^2), x=-infinity..infinity)); evalf(Int(f, 0..1));"
    )
    assert printed(text) == [
        ".25",
        "8/3",
        "int(p,0 .. 1)",
        f"{math.sin(1):.10f}".lstrip("0").rstrip("0"),
        ".125",
        ".125",
        f"{math.sqrt(math.pi):.9f}",
        "Int(f,0 .. 1)",
    ]


def test_what_has_no_degree_or_coefficient() -> None:
    assert printed("degree(0,x); degree(sin(x),x); degree((x+1)^2-x^2,x);") == ["-infinity", "FAIL", "1"]
    assert printed("coeff(a*sqrt(x)+b*x,sqrt(x)); coeffs(a*sqrt(x)+b,sqrt(x));") == ["a", "b, a"]
    interpreter = Interpreter()
    assert printed("coeff(sin(x)+2*x,x);", None, interpreter) == ["2"]
    assert interpreter.session.notices == [
        "coeff: sin(x)+2*x is no polynomial in x; what else depends on it counts as known"
    ]
    assert failures("coeff(a*x^n,x,n);") == ["coeff: the power n; expected an integer"]


def test_a_new_value_of_a_function_forgets_its_entries() -> None:
    assert printed("f(2) := 5: f := x -> x^2: f(2); f(3) := 1: f(3); f(2);") == ["4", "1", "4"]


def test_normal_is_one_fraction() -> None:
    sheet = "normal(a/b+c/d); normal(1/(x+1)+1/(x-1)); normal(sin(x)/cos(x)+1); normal((a+b)^2/(a^2-b^2));"
    assert printed(sheet) == ["(a*d+b*c)/b/d", "2*x/(x^2-1)", "(cos(x)+sin(x))/cos(x)", "(a+b)/(a-b)"]
