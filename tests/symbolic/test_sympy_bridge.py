"""To SymPy and back: the same structure, the same values, and shared terms stay shared."""

from __future__ import annotations

import sys
from random import Random

import pytest
import sympy
from sympy.physics.mechanics import dynamicsymbols

from symbody.errors import ExpressionError
from symbody.symbolic import (
    Expr,
    Piecewise,
    cos,
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
from symbody.symbolic.sympy_bridge import from_sympy, to_sympy
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


@pytest.mark.parametrize("seed", range(150))
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
    e = doubling(100)  # a tree of 2**100 terms
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
