"""To SymPy and back: the same structure, the same values, and shared terms stay shared."""

from __future__ import annotations

import builtins
import sys
from random import Random
from typing import Any

import numpy as np
import pytest
import sympy
from sympy.codegen.cfunctions import expm1, log1p
from sympy.physics.mechanics import LagrangesMethod, ReferenceFrame, dynamicsymbols

from symbody.errors import ExpressionError, ModelNotice
from symbody.symbolic import (
    Expr,
    Matrix,
    Piecewise,
    cos,
    exp,
    function,
    functions_of_time,
    identity,
    number,
    pi,
    sin,
    sqrt,
    symbols,
    t,
    time_derivative,
)
from symbody.symbolic.sympy_bridge.structured import from_sympy, to_sympy
from tests.repeated import repeated
from tests.symbolic.random_expression import doubling, expression

a, b = symbols("a b")
p = symbols("p", positive=True)
x = functions_of_time("x")
f = function("f")

A, B, P = sympy.Symbol("a", real=True), sympy.Symbol("b", real=True), sympy.Symbol("p", positive=True)
T = sympy.Symbol("t")
X = dynamicsymbols("x")
F = sympy.Function("f")


@pytest.mark.parametrize(
    ("ours", "theirs"),
    [
        (a * sin(b) ** 2 + number(2) / 3, A * sympy.sin(B) ** 2 + sympy.Rational(2, 3)),
        (0.5 * a, sympy.Float(0.5) * A),
        (pi * t, sympy.pi * T),
        (sqrt(p) / b, sympy.sqrt(P) / B),
        (a**b, A**B),
        (time_derivative(x, 2) + x * a, X.diff(T, 2) + X * A),
        (f(a, x), F(A, X)),
        (f.derivative([1, 2], a, b), F(A, B).diff(A, B, B)),
        (b * f.derivative([1], a * b), F(A * B).diff(A)),
        (f.derivative([1, 0], a, a) + f.derivative([0, 1], a, a), F(A, A).diff(A)),
        (Piecewise((a, b), otherwise=0), sympy.Piecewise((A, B > 0), (0, True))),
    ],
)
def test_the_structure_is_the_same_on_both_sides(ours: Expr, theirs: sympy.Basic) -> None:
    assert from_sympy(theirs) == ours
    made = to_sympy(ours)
    # SymPy numbers the inner variables of a partial derivative; what counts is that they read back.
    assert made == theirs or (made.has(sympy.Subs) and from_sympy(made) == ours)


@pytest.mark.parametrize("seed", [*range(60), *repeated(range(60, 150))])
def test_there_and_back(seed: int) -> None:
    e = expression(seed, 3)
    there = to_sympy(e)
    if not there.has(sympy.I, sympy.nan, sympy.zoo):  # SymPy takes roots of negative numbers
        assert_same_value(from_sympy(there), e)


def assert_same_value(found: Expr, expected: Expr) -> None:
    """Equal by fingerprint, or where SymPy has evaluated an opaque function, in doubles."""
    if found != expected:
        difference = to_sympy(found - expected)
        assert abs(numeric(difference, 1)) < 1e-9 * (1 + abs(numeric(to_sympy(expected), 1)))


def numeric(e: sympy.Expr, seed: int) -> complex:
    """Return the value at a random point, undefined functions replaced by smooth ones."""
    random = Random(seed)
    smooth = sympy.Lambda((A, B), sympy.sin(A + 2 * B) + A * B)
    e = e.replace(F, smooth).replace(sympy.Function("g"), smooth).doit()
    variables = sorted(e.atoms(sympy.Derivative), key=lambda d: -d.derivative_count)
    variables += sorted(e.atoms(sympy.core.function.AppliedUndef), key=str)
    for variable in variables:
        e = e.subs(variable, random.uniform(0.2, 0.9))
    return complex(e.subs({s: random.uniform(0.2, 0.9) for s in sorted(e.free_symbols, key=str)}))


def test_values_agree_with_sympy() -> None:
    e = sin(a) ** 2 * cos(b - x) / (1 + p) + time_derivative(x) ** 3
    point = {A: 0.3, B: 0.7, P: 1.2, X.diff(T): 0.4, X: -0.6}
    ours = e.subs({a: 0.3, b: 0.7, p: 1.2, time_derivative(x): 0.4, x: -0.6})
    assert float(to_sympy(e).subs(point)) == pytest.approx(float(ours), rel=1e-14)


def test_derivatives_agree_with_sympy() -> None:
    e = sin(a * x) ** 2 / (1 + b * a)
    assert from_sympy(to_sympy(e).diff(A)) == e.diff(a)
    assert from_sympy(to_sympy(e).diff(T)) == time_derivative(e)


def test_symbols_keep_their_assumptions() -> None:
    plain = symbols("z", real=False)
    for ours, theirs in ((a, A), (p, P), (plain, sympy.Symbol("z", complex=True))):
        assert to_sympy(ours) == theirs
        assert from_sympy(theirs) == ours
    assert from_sympy(sympy.Symbol("a")) == a, "symbols are real unless one says otherwise"


def test_names_choose_the_objects() -> None:
    m = sympy.Symbol("m")
    assert to_sympy(a + x, {"a": m}) == m + X
    assert from_sympy(m + X, {"m": a, "x": b}) == a + b


def test_shared_terms_stay_shared() -> None:
    e = doubling(60)  # a tree of 2**60 terms
    assert from_sympy(to_sympy(e)) == e


@pytest.mark.parametrize(
    ("condition", "value"),
    [
        (A >= B, [0, 1, 1]),
        (A <= B, [1, 1, 0]),
        (A > B, [0, 0, 1]),
        (sympy.Eq(A, B), [0, 1, 0]),
        (sympy.Ne(A, B), [1, 0, 1]),
        (sympy.And(A < 2, B < 2, A < B), [1, 0, 0]),
        (sympy.Or(A > B, sympy.And(A < B, B > 0)), [1, 0, 1]),
        (sympy.Not(sympy.And(A > B, B > 0)), [1, 1, 0]),
    ],
)
def test_conditions(condition: sympy.Basic, value: list[int]) -> None:
    chosen = from_sympy(sympy.Piecewise((1, condition), (0, True), evaluate=False))
    assert [chosen.subs({a: at, b: 1}) for at in (0, 1, 2)] == value


@pytest.mark.parametrize(
    ("theirs", "message"),
    [
        (A + sympy.I, "SymPy's ImaginaryUnit has no counterpart here: I"),
        (sympy.oo, "SymPy's Infinity has no counterpart here: oo"),
        (sympy.besselj(0, A), r"SymPy's besselj has no counterpart here: besselj\(0, a\)"),
        (sympy.Piecewise((A, B > 0)), r"the Piecewise has no last branch \(value, True\)"),
    ],
)
def test_what_has_no_counterpart(theirs: sympy.Basic, message: str) -> None:
    with pytest.raises(ExpressionError, match=message):
        from_sympy(theirs)


def test_sympy_is_an_extra(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "sympy", None)
    with pytest.raises(ImportError, match=r"SymPy isn't installed; pip install 'symbody\[sympy\]'"):
        to_sympy(a)


@pytest.mark.parametrize(
    "error", [OSError("no gmp"), ModuleNotFoundError("No module named 'mpmath'", name="mpmath")]
)
def test_a_sympy_that_cannot_be_loaded_is_not_called_missing(
    monkeypatch: pytest.MonkeyPatch, error: Exception
) -> None:
    import_now = builtins.__import__

    def failing(name: str, *rest: Any) -> Any:
        if name == "sympy":
            raise error
        return import_now(name, *rest)

    monkeypatch.setattr(builtins, "__import__", failing)
    with pytest.raises(type(error), match=str(error)):
        to_sympy(x)


# --- what mechanics brings along ---

REAL = sympy.Symbol("a", real=True)


@pytest.mark.parametrize(
    "theirs",
    [
        sympy.Heaviside(REAL),
        sympy.Heaviside(REAL, 0),
        sympy.Heaviside(REAL, 1),
        sympy.Heaviside(REAL - 1, sympy.Rational(1, 3)),
        sympy.sinc(REAL),
        sympy.Heaviside(REAL) * sympy.sinc(REAL**2),
        sympy.sign(REAL) * sympy.Abs(REAL),
        sympy.Max(REAL, 0, -1) + sympy.Min(REAL, 1),
        sympy.atan2(REAL, -1),
        sympy.cbrt(REAL**2),
        sympy.Piecewise((REAL, REAL > 0), (sympy.sin(REAL), REAL < -1), (2, True)),
    ],
)
def test_functions_with_corners_agree_at_the_corners(theirs: sympy.Basic) -> None:
    ours = from_sympy(theirs)
    for at in (-1.5, -1.0, -0.5, 0.0, 0.25, 1.0, 2.0):
        assert ours.evaluate({a: at}) == pytest.approx(float(theirs.subs(REAL, at)), rel=1e-14)


INVERSES = [
    "sec", "csc", "cot", "sech", "csch", "coth", "asinh", "atanh", "asec", "acsc", "acot", "acosh",
    "asech", "acsch", "acoth",
]  # fmt: skip


@pytest.mark.parametrize("name", INVERSES)
def test_functions_by_others_agree(name: str) -> None:
    theirs = getattr(sympy, name)(REAL)
    at = {"asec": 1.7, "acsc": 1.7, "acosh": 1.7, "acoth": 1.7}.get(name, 0.6)
    for sign_of in (1, -1) if name not in {"acosh", "asech"} else (1,):
        assert from_sympy(theirs).evaluate({a: sign_of * at}) == pytest.approx(
            float(theirs.subs(REAL, sign_of * at)), rel=1e-13
        )
    slope = from_sympy(theirs).diff(a).evaluate({a: at})
    assert slope == pytest.approx(float(theirs.diff(REAL).subs(REAL, at)), rel=1e-13)


def test_matrices_and_lists() -> None:
    ours = Matrix([[a, sin(x)], [0.5, time_derivative(x)]])
    theirs = sympy.Matrix([[A, sympy.sin(X)], [0.5, X.diff(T)]])
    assert ours.to_sympy() == to_sympy(ours) == theirs
    for kind in (sympy.Matrix, sympy.ImmutableMatrix, sympy.SparseMatrix, sympy.ImmutableSparseMatrix):
        assert from_sympy(kind(theirs)) == ours
    assert from_sympy(theirs.T * 2) == 2 * ours.T
    assert from_sympy(2 * sympy.ImmutableMatrix(theirs).T) == 2 * ours.T
    assert from_sympy(sympy.Identity(2)) == identity(2)
    assert from_sympy(sympy.zeros(0, 3)).shape == (0, 3)
    assert from_sympy([A, (B, [theirs])]) == [a, (b, [ours])]
    assert from_sympy(sympy.Tuple(A, B)) == (a, b)
    assert from_sympy(sympy.Array([[A, B], [1, 2]])) == [[a, b], [1, 2]]
    assert from_sympy({A: 1, X: sympy.Rational(1, 2)}) == {a: 1, x: number("1/2")}
    assert to_sympy([a, (b, {x: 1})]) == [A, (B, {X: 1})]
    assert list(from_sympy(np.array([A, B], dtype=object))) == [a, b]
    assert from_sympy([a, ours]) == [a, ours]


def test_many_entries_that_sympy_makes_on_the_fly() -> None:
    """Entries of SymPy's matrices may be new objects at each call, in the places of others that are gone."""
    entries = [[A ** (i + 1) + j for j in range(30)] for i in range(30)]
    found = from_sympy(sympy.Matrix(entries))
    assert found == Matrix([[a ** (i + 1) + j for j in range(30)] for i in range(30)])


def test_equations_are_differences() -> None:
    assert from_sympy(sympy.Eq(A * X, B)) == a * x - b
    assert from_sympy([sympy.Eq(A, 1), sympy.Eq(B, A)]) == [a - 1, b - a]


def test_numbers_are_exact() -> None:
    assert from_sympy(sympy.Float("0.1", 40)) == number("1/10")
    assert from_sympy(sympy.Float("0.12345678901234567890123", 23)) == number("0.12345678901234567890123")
    assert from_sympy(sympy.Float(2) ** 0.5) == number(2**0.5)
    assert from_sympy(sympy.E) == exp(1)
    for value in (
        number("1/3"),
        number(0.1),
        number(0.1) / 3,
        number(0.1) * number(1e-17) + 1,
        number(10) ** 30,
    ):
        assert from_sympy(to_sympy(value)) == value


def test_from_mechanics_of_sympy() -> None:
    """Lagrange's equations as SymPy derives them are ours."""
    m, g, l = sympy.symbols("m g l", positive=True)
    q = dynamicsymbols("q")
    L = m * l**2 * q.diff(T) ** 2 / 2 + m * g * l * sympy.cos(q)
    method = LagrangesMethod(L, [q])
    found = from_sympy(method.form_lagranges_equations())
    theta, (M, G, R) = functions_of_time("q"), symbols("m g l", positive=True)
    assert found == Matrix([[M * R**2 * time_derivative(theta, 2) + M * G * R * sin(theta)]])
    assert from_sympy(method.mass_matrix) == Matrix([[M * R**2]])


REFUSED = [
    (sympy.DiracDelta(A), "DiracDelta has no counterpart here: .*; an impulse has no value"),
    (sympy.Integral(X, T), "Integral has no counterpart here: .*; let SymPy evaluate it first"),
    (
        sympy.conjugate(sympy.Symbol("z")),
        r"conjugate has .*; expressions are real; make SymPy's symbols",
    ),
    (sympy.re(sympy.Symbol("z")) + A, r"re has .*; expressions are real"),
    (sympy.Abs(sympy.Symbol("z")).diff(sympy.Symbol("z")), r"re has .*; expressions are real"),
    (A > 0, r"StrictGreaterThan has .*; a condition is not a number"),
    (sympy.nan, r"NaN has .*; expressions hold finite numbers only"),
    (sympy.floor(A), r"floor has .*; it is not continuous"),
    (sympy.MatrixSymbol("M", 2, 2), r"MatrixSymbol has .*; a matrix needs its entries"),
    (sympy.MatrixSymbol("M", 2, 2) * sympy.MatrixSymbol("N", 2, 2), r"MatrixSymbol has .*; a matrix needs"),
    (ReferenceFrame("N").x, r"N\.x is a Vector of sympy\.physics; convert its components"),
    (sympy.Lambda(A, A**2), "Lambda has no counterpart here"),
]


@pytest.mark.parametrize(("theirs", "message"), REFUSED, ids=[row[1][:20] for row in REFUSED])
def test_what_is_refused_says_why(theirs: object, message: str) -> None:
    with pytest.raises(ExpressionError, match=message):
        from_sympy(theirs)


@pytest.mark.parametrize("seed", range(10))
def test_structures_there_and_back(seed: int) -> None:
    entries = [expression(100 * seed + k, 2) for k in range(4)]
    there = to_sympy({a: (entries, Matrix([entries]))})
    back = from_sympy(there)[a]
    if not sympy.Matrix(there[A][0]).has(sympy.I, sympy.nan, sympy.zoo):
        for found, expected in zip([*back[0], *back[1]], [*entries, *entries], strict=True):
            assert_same_value(found, expected)


def test_texts_as_keys_stay() -> None:
    assert to_sympy({"mass": a, "list": [x]}) == {"mass": A, "list": [X]}
    assert from_sympy({"mass": A, "more": {"list": [X]}}) == {"mass": a, "more": {"list": [x]}}


def test_symbols_that_are_not_real_are_refused() -> None:
    imaginary = sympy.Symbol("z", imaginary=True)
    with pytest.raises(
        ExpressionError, match=r"from_sympy: z is imaginary; expressions are real: make it with"
    ):
        from_sympy(imaginary + 1)
    assert from_sympy(imaginary + 1, names={"z": a}) == a + 1
    with pytest.raises(ExpressionError, match=r"from_sympy: z is not real; "):
        from_sympy(sympy.Symbol("z", real=False))


def test_a_negative_symbol_has_a_notice() -> None:
    negative = sympy.Symbol("n", negative=True)
    with pytest.warns(ModelNotice, match=r"from_sympy: n is negative, and becomes a real symbol") as notices:
        assert from_sympy(2 * negative) == 2 * symbols("n")
    assert notices[0].filename == __file__
    size = symbols("size", positive=True)
    assert from_sympy(2 * negative, names={"n": -size}) == -2 * size


def test_log1p_is_refused() -> None:
    with pytest.raises(
        ExpressionError, match=r"log1p has no counterpart here: log1p\(a\); write log\(1 \+ x\)"
    ):
        from_sympy(log1p(A))
    assert from_sympy(expm1(A)).evaluate({a: 1e-17}) == 1e-17
    assert from_sympy(sympy.asinh(A)).evaluate({a: -1e8}) == pytest.approx(-19.113827924512310, rel=1e-15)
