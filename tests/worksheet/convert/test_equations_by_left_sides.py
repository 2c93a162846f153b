"""Solutions in programs, dictionaries by their left sides: mapped, derived, united, and integrated."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import symbody as sb
from symbody.worksheet.convert.program import Converted, converted
from symbody.worksheet.convert.same import same
from symbody.worksheet.interpreter.interpret import Interpreter
from symbody.worksheet.reading.files import source_cells
from tests.worksheet.printed_by import printed

pytestmark = pytest.mark.filterwarnings("ignore::symbody.errors.ModelNotice")
"""Other tests of this process use the names of these sheets for other things."""


def made(sheet: str) -> tuple[Converted, dict[str, Any]]:
    """Return the program of a sheet, all of which is code, and its variables after a run."""
    program = converted(source_cells(sheet), "equations")
    assert (program.values, program.left_out, program.failed) == (0, 0, 0)
    values: dict[str, Any] = {}
    exec(program.text, values)
    return program, values


OSCILLATOR = (
    "rates := solve({diff(x(t),t) = w*v(t)}, {diff(x(t),t)}): forces := solve({diff(v(t),t)+w*x(t)}, {diff(v(t),t)}):\n"
    "both := rates union forces: sums := map(rhs, both): odes := subs(w = 2, both):\n"
    "twice := map(e -> lhs(e) = 2*rhs(e), rates): later := diff(rates, t):\n"
)


def test_equations_by_left_sides_are_mapped_derived_and_united() -> None:
    program, values = made(OSCILLATOR)
    assert "both = {**rates, **forces}\n" in program.text
    assert (
        "later = {sb.diff(left, sb.t): sb.diff(right, sb.t) for left, right in rates.items()}\n"
        in program.text
    )
    x, v, w = values["x"], values["v"], values["w"]
    assert values["sums"] == [w * v, -w * x]
    assert values["twice"] == {sb.diff(x, sb.t): 2 * w * v}
    assert values["later"] == {sb.diff(x, sb.t, 2): w * sb.diff(v, sb.t)}


def test_motions_of_united_solutions_obey_their_equations() -> None:
    _, values = made(f"{OSCILLATOR}s := dsolve(odes union {{x(0) = 1, v(0) = 0}}, numeric, range = 0..3):")
    motion = values["s"]
    assert np.asarray(motion[values["x"]]) == pytest.approx(np.cos(2 * np.asarray(motion.t)), abs=1e-5)


def test_initial_values_have_a_name_as_in_the_worksheet() -> None:
    program, values = made(
        "ode := diff(x(t),t,t) = -4*x(t): start := {x(0) = 1, D(x)(0) = a}: a := 0: again := x(0) = 2, D(x)(0) = 0:\n"
        "s := dsolve({ode} union start, numeric, range = 0..3): r := dsolve({ode, again}, numeric, range = 0..3):"
    )
    assert "start = {x: 1, sb.diff(x, sb.t): a}\n" in program.text
    assert "again = {x: 2, sb.diff(x, sb.t): 0}\n" in program.text
    for name, size in (("s", 1), ("r", 2)):
        motion = values[name]
        exact = size * np.cos(2 * np.asarray(motion.t))
        assert np.asarray(motion[values["x"]]) == pytest.approx(exact, abs=1e-5 * size)


def test_a_motion_of_other_equations_is_not_the_same() -> None:
    interpreter = Interpreter()
    printed("s := dsolve({diff(x(t),t) = -x(t), x(0) = 1}, numeric):", None, interpreter)
    x = sb.functions_of_time("x")
    for rate, expected in ((1, True), (2, False)):
        equations = sb.equations_from_differential([sb.diff(x, sb.t) + rate * x], [x])
        motion = sb.simulate(equations, initial={x: 1}, t=(0, 10))
        assert same(interpreter.session, motion, interpreter.session.names["s"]) is expected


def test_vectors_of_components_and_their_jacobian() -> None:
    program, values = made(
        "restart: with(MBSymba_r6): P := origin(rotate('Z',q(t))*translate(a,0,0)): p := <comp_XYZ(P,ground)>:\n"
        "J := VectorCalculus[Jacobian]([comp_XYZ(P,ground)], [q(t)]): v := <comp_XYZ(velocity(P))>:\n"
        "both := solve({u^2 = 4, w = u}, {u, w}): n := nops([both]): d := simplify(v - J . <diff(q(t),t)>):"
    )
    assert "p = sb.Matrix.column([*" in program.text
    assert values["n"] == 2
    assert values["d"] == sb.Matrix([[0], [0], [0]])
