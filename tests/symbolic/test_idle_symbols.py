"""Idle symbols: what the value doesn't hold, the form shouldn't. SymPy's derivatives say what a value holds."""

from __future__ import annotations

import random

import pytest

from symbody import (
    Abs,
    Expr,
    Link,
    Max,
    assemble,
    contact,
    cos,
    cost,
    exp,
    free,
    functions_of_time,
    ground,
    newton_euler,
    number,
    pi,
    planar,
    rotate,
    sin,
    sqrt,
    symbols,
    tan,
    time_derivative,
    translate,
)
from symbody.symbolic import derivation, idle_symbols, linear_solve, without_idle_symbols

sympy = pytest.importorskip("sympy")

a, b, c, d, s = symbols("a b c d s")
q, x = functions_of_time("q x")
CUBIC = s**3 - 3 * s**2 + 2 * s

CASES = [
    (a * b + a * c) / (b + c),
    a * sin(q) ** 2 + a * cos(q) ** 2 + b,
    sin(q) * (b * cos(q) + a * sin(q)) + cos(q) * (a * cos(q) - b * sin(q)),
    cos(q + s) * cos(s) + sin(q + s) * sin(s),
    a * (s + b) - (a * s - c),
    (a * exp(s) + b * exp(s)) * exp(-s),
    (a * s + b * s) / (c * s + d * s),
    (a * tan(q) + b * tan(q)) / tan(q),
    (a * sqrt(s**2 + 1) + b * sqrt(s**2 + 1)) / sqrt(s**2 + 1),
    (a * CUBIC + b * CUBIC) / CUBIC,
    a * (x + s) - a * s,
    a * b + c * sin(q),
    Abs(a - s) + b,
]

KEPT = [CASES[9]]
"""Without s, it would divide by zero at each number that is tried."""


def needed(e: Expr) -> set[Expr]:
    """Return the symbols by which SymPy's derivative isn't zero at random points."""
    text, values = e.to_sympy(), random.Random(1)
    result = set()
    for leaf in e.free_symbols:
        mine = {other: other.to_sympy() for other in e.free_symbols}
        plain = {other: sympy.Symbol(f"v{k}", real=True) for k, other in enumerate(sorted(mine, key=str))}
        flat = text.subs({mine[other]: plain[other] for other in mine})
        slope = sympy.diff(flat, plain[leaf])
        point = {v: sympy.Rational(values.randint(20, 60), 37) for v in plain.values()}
        if abs(slope.subs(point).evalf(30)) > 1e-20:
            result.add(leaf)
    return result


@pytest.mark.parametrize("e", CASES, ids=str)
def test_what_is_idle(e: Expr) -> None:
    assert {*idle_symbols([e])} == e.free_symbols - needed(e)


@pytest.mark.parametrize("e", CASES, ids=str)
def test_forms_without_idle_symbols(e: Expr) -> None:
    (form,) = without_idle_symbols([e])
    assert form == e
    assert cost(form).total <= cost(e).total
    if e not in KEPT:
        assert form.free_symbols == needed(e)
    assert sympy.simplify(form.to_sympy() - e.to_sympy()) == 0


@pytest.mark.parametrize("e", KEPT, ids=str)
def test_a_symbol_stays_if_each_form_without_it_has_other_poles(e: Expr) -> None:
    assert idle_symbols([e]) == (s,)
    assert without_idle_symbols([e]) == (e,)
    assert s in without_idle_symbols([e])[0].free_symbols


def test_a_symbol_is_idle_in_all_expressions_or_in_none() -> None:
    e = (a * b + a * c) / (b + c)
    assert idle_symbols([e, b]) == (c,)
    assert idle_symbols([e, b + c]) == ()
    assert idle_symbols([]) == ()
    assert without_idle_symbols([e, number(2), e]) == (a, number(2), a)


@pytest.mark.parametrize("k", range(8))
def test_a_symbol_of_one_branch_is_not_idle(k: int) -> None:
    """Each sign is a coin in a lane: of a few symbols, some are on either side of a kink there."""
    e = a * Max(0, symbols(f"x{k}")) + b
    assert idle_symbols([e]) == ()
    assert idle_symbols([Abs(e) * c - Abs(e) * (c + s)]) == (c,)


def test_a_contact_is_derived_without_trials() -> None:
    """Whatever one of its branches lacks, the residuals hold: of 13 symbols, each was replaced by three numbers."""
    table, block = Link("table", 4, 0.2, 0.3, 0.4), Link("block", 1, 0.01, 0.01, 0.01)
    made = assemble([planar("H", ground, table, axis="Y"), free("F", ground, block)])
    plane = made.frame(table) * translate(0, 0, 0.02) * rotate("Y", 0.1)
    rubbing = {"damping": 0.3, "friction": 0.4, "creep_speed": 0.01}
    bodies = {"on": made.body(block), "reaction": made.body(table)}
    touch = contact(made.point(block, 0.02, 0, -0.05), 0.05, 1e5, plane=plane, **rubbing, **bodies)
    equations = newton_euler(made.system([touch]))
    assert idle_symbols(equations.residuals) == ()
    assert idle_symbols([*equations.mass_matrix.entries, *equations.bias]) == ()


def test_rates_stay_if_their_function_is_idle() -> None:
    v, w = time_derivative(x), time_derivative(x, 2)
    e = v * (a + x) - v * x + w
    assert idle_symbols([e]) == (x,)
    (form,) = without_idle_symbols([e])
    assert form.free_symbols == {a, v, w}
    e = w * (a + v) - w * v + x
    (form,) = without_idle_symbols([e])
    assert form.free_symbols == {w, x, a}


def test_angles_are_replaced_by_right_angles_where_zero_divides() -> None:
    e = (a * sin(q) + b * sin(q)) / sin(q)
    assert without_idle_symbols([e]) == (a + b,)
    e = (a * cos(q - pi / 2) + b * cos(q - pi / 2)) / sin(q)
    assert without_idle_symbols([e])[0].free_symbols == {a, b}


def test_solutions_of_linear_systems_need_what_their_parts_hold() -> None:
    solution = linear_solve([[a, b], [c, d]], [s, 1])
    assert idle_symbols(solution) == ()


def test_the_result_does_not_depend_on_the_derivation() -> None:
    e = sin(q) * (b * cos(q) + a * sin(q)) + cos(q) * (a * cos(q) - b * sin(q)) + c
    with derivation():
        (e + 1) * 2
        inside = without_idle_symbols([e])
    assert [str(form) for form in inside] == [str(form) for form in without_idle_symbols([e])] == ["a + c"]


@pytest.mark.parametrize(
    ("e", "kept"),
    [
        ((a * s + b * s) / (c * s + d * s), False),
        (a / (s * (b + c)) * s**2 / (2 * s), False),
        (s * (a + b) / (s * (a + s) - s**2), False),
        ((a + s * b - s * b) / (c + s * (d - c)) * (c + s * (d - c)), True),
    ],
    ids=str,
)
def test_a_factor_of_a_divisor_goes(e: Expr, kept: bool) -> None:
    """Whatever makes the shorter divisor zero makes the given one zero, so that no pole is new."""
    if s in e.free_symbols:
        assert (s in without_idle_symbols([e])[0].free_symbols) == kept
    assert without_idle_symbols([e]) == (e,)
