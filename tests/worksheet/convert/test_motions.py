"""Programs integrate what dsolve does, however the sheet writes its problem."""

from __future__ import annotations

import numpy as np
import pytest

from symbody.worksheet.convert.program import converted
from symbody.worksheet.interpreter.interpret import Interpreter
from symbody.worksheet.reading.files import source_cells

OSCILLATOR = "sys := {diff(p(t),t)=q(t), diff(q(t),t)=-k*p(t)}: ini := {p(0)=1, q(0)=0}: num := [k=4]: "
COSINE = np.cos(2 * 1.5)


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


@pytest.mark.parametrize("rule", ["proc(s) u(s) end proc", "s -> u(s)", "proc(a) u(a) end proc"])
def test_rules_of_derivatives_have_any_parameter(rule: str) -> None:
    found = values(
        f"with(MBSymba_r6): `diff/x` := {rule}: a := 2*b: B := make_BODY(translate(x(t),0,0), m): "
        "n := comp_X(newton_equations({B})):"
    )
    assert str(found["n"]) == "m*u'"
