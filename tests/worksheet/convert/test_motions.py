"""Programs integrate what dsolve does, however the sheet writes its problem."""

from __future__ import annotations

import numpy as np
import pytest

from symbody.worksheet.convert.program import converted
from symbody.worksheet.interpreter.interpret import Interpreter
from symbody.worksheet.reading.files import source_cells

OSCILLATOR = "sys := {diff(p(t),t)=q(t), diff(q(t),t)=-k*p(t)}: ini := {p(0)=1, q(0)=0}: num := [k=4]: "
COSINE = np.cos(2 * 1.5)
pytestmark = pytest.mark.filterwarnings("ignore::symbody.errors.ModelNotice")
"""Other tests of this process use the names of these sheets for other things."""


def values(sheet: str) -> dict[str, object]:
    """Return the variables of the program of a sheet, in which nothing is left out."""
    interpreter = Interpreter()
    made = converted(source_cells(sheet), "sheet", interpreter.session)
    assert not made.left_out
    found: dict[str, object] = {}
    exec(made.text, found)
    return found


@pytest.mark.parametrize(
    "problem",
    [
        "subs(num, sys union ini)",
        "subs(num, {op(sys), op(ini)})",
        "subs(k=4, sys) union {p(0)=1, q(0)=0}",
        "subs(num, [diff(p(t),t)=q(t), diff(q(t),t)=-k*p(t), p(0)=1, q(0)=0])",
    ],
)
def test_problems_are_unions_and_substitutions(problem: str) -> None:
    found = values(f"{OSCILLATOR} s := dsolve({problem}, numeric, range=0..1.5):")
    assert found["s"][found["p"]][-1] == pytest.approx(COSINE, abs=1e-5)  # type: ignore[index]


def test_a_problem_is_one_equation_and_begins_at_any_time() -> None:
    found = values(
        "eq := diff(x(t),t,t)+k*x(t)=0: s := dsolve({subs([k=4],eq), x(1)=1, D(x)(1)=0}, numeric): "
        "r := dsolve({subs(k=4,eq), x(0.5)=1, D(x)(0.5)=0}, numeric, range=0.5..2):"
    )
    x = found["x"]
    assert found["s"][x][-1] == pytest.approx(np.cos(2 * 10), abs=1e-4)  # type: ignore[index]
    assert found["r"][x][-1] == pytest.approx(COSINE, abs=1e-5)  # type: ignore[index]


def test_multipliers_stay_multipliers() -> None:
    found = values(
        "eqs := [2*diff(x(t),t,t)+lam(t)*x(t), 2*diff(z(t),t,t)+lam(t)*z(t)-2*g]: "
        "s := dsolve({x(t)^2+z(t)^2=0.25, op(subs(g=9.81,eqs)), x(0)=0.3,z(0)=0.4,D(x)(0)=0,D(z)(0)=0}, numeric, "
        "range=0..0.5):"
    )
    assert found["s"][found["x"]][-1] == pytest.approx(-0.1754130143, abs=1e-5)  # type: ignore[index]


@pytest.mark.parametrize(
    "rule",
    [
        *("proc(s) u(s) end proc", "s -> u(s)", "proc(a) u(a) end proc"),
        *("proc(s, x) u(s)*diff(s, x) end proc", "(a, b) -> diff(a, b)*u(a)"),
    ],
)
def test_rules_of_derivatives_have_any_parameter(rule: str) -> None:
    found = values(
        f"with(MBSymba_r6): `diff/x` := {rule}: a := 2*b: B := make_BODY(translate(x(t),0,0), m): "
        "n := comp_X(newton_equations({B})):"
    )
    assert str(found["n"]) == "m*u'"


def test_values_of_a_motion_at_times_are_integrated_up_to_them() -> None:
    """A program that is run for other times gives what the closed solution has there."""
    problem = "subs(k=4, {diff(x(t),t,t)+k*x(t)=0, ic}), numeric"
    found = values(
        f"ic := x(0)=1, D(x)(0)=0: s := dsolve({problem}): a := rhs(s(1.5)[2]): s(0); "
        "for i to 2 do b[i] := subs(s(i*0.5), x(t)) end do: "
        f"p := dsolve({problem}, output=listprocedure): fx := rhs(p[2]): fv := eval(diff(x(t),t), p): "
        f"r := dsolve({problem}, output=array([0,0.5,1.0,1.5])): names := r[1,1]: rows := r[2,1]: "
    )
    assert found["a"] == pytest.approx(COSINE, abs=1e-8)
    assert [*map(float, found["b"].values())] == pytest.approx(np.cos([1, 2]), abs=1e-8)  # type: ignore[attr-defined]
    assert found["fx"](11.0) == pytest.approx(np.cos(22), abs=1e-7)  # type: ignore[operator]
    assert found["fv"](0.7) == pytest.approx(-2 * np.sin(1.4), abs=1e-8)  # type: ignore[operator]
    assert [str(each) for each in found["names"]] == ["t", "x", "x'"]  # type: ignore[attr-defined]
    assert [row[1] for row in found["rows"]] == pytest.approx(np.cos([0, 1, 2, 3]), abs=1e-8)  # type: ignore[attr-defined]


def test_sequences_of_initial_values_and_unknowns_with_indices() -> None:
    found = values(
        "n := 2: eqs := [seq(m[i]*diff(q[i](t),t,t) = -k*q[i](t), i=1..n)]: num := {seq(m[i]=2, i=1..n), k=8}: "
        "ics := {seq(q[i](0)=0.1*i, i=1..n), seq(D(q[i])(0)=0, i=1..n)}: "
        "s := dsolve(subs(num, {op(eqs)}) union ics, numeric, range=0..1.5):"
    )
    assert found["s"][found["q_2"]][-1] == pytest.approx(0.2 * COSINE, abs=1e-5)  # type: ignore[index]


def test_integrals_of_numbers_are_those_of_scipy() -> None:
    found = values(
        "a := evalf(2*Int(sin(x)*exp(-x), x = 0..infinity)): f := n -> evalf(Int(cos(n*t)^2, t = 0..Pi)): b := f(2):"
    )
    assert (found["a"], found["b"]) == pytest.approx((1, np.pi / 2))


def test_only_the_item_that_has_no_text_is_a_value(capsys: pytest.CaptureFixture[str]) -> None:
    values('a := 3*x: a + 1, diff(a, x), length("abc"), a - x;')
    assert capsys.readouterr().out == "3*x + 1 3 3 2*x\n"
