"""What a program prints is what the worksheet prints."""

from __future__ import annotations

import pytest

import symbody as sb
from symbody.worksheet.convert.program import Converted, converted
from symbody.worksheet.convert.same import same
from symbody.worksheet.evaluation.session import Session
from symbody.worksheet.interpreter.interpret import Interpreter
from symbody.worksheet.reading import statements
from symbody.worksheet.reading.files import source_cells

pytestmark = pytest.mark.filterwarnings("ignore::symbody.errors.ModelNotice")
"""Other tests of this process use the names of these sheets for other things."""

RULE = "with(MBSymba_r6): `diff/phi` := proc(t) p(t) end proc:\n"
TWO_TURNS = RULE + "T := rotate('Z',theta(t))*rotate('X',phi(t)): P := make_POINT(T,0,0,c):\n"


def made(text: str) -> Converted:
    return converted(source_cells(text), "shown")


@pytest.mark.parametrize(
    ("shown", "expected"),
    [
        ("angular_velocity(T)", "comps = [p, sin(phi)*theta', cos(phi)*theta']"),
        ("project(velocity(P), T)", "comps = [c*sin(phi)*theta', -c*p, 0]"),
        ("angular_momentum(make_BODY(T,0,A,B,C), P)", "comps = [A*p, B*sin(phi)*theta', C*cos(phi)*theta']"),
        ("angular_velocity(T), synthetic", "comps = [p, sin(phi)*theta', cos(phi)*theta']"),
    ],
)
def test_what_show_prints_obeys_the_rules_of_derivatives(
    shown: str, expected: str, capsys: pytest.CaptureFixture[str]
) -> None:
    program = made(f"{TWO_TURNS}show({shown}); show(%);")
    assert (program.values, program.left_out) == (0, 0)
    exec(program.text, {})
    first, second = capsys.readouterr().out.splitlines()
    assert expected in first
    assert expected in second


def test_rates_of_rates_are_shown_by_the_rules(capsys: pytest.CaptureFixture[str]) -> None:
    program = made(RULE + "`diff/p` := proc(t) -k*phi(t) end proc: diff(phi(t),t,t), diff(sin(phi(t)),t);")
    assert program.left_out == 0
    exec(program.text, {})
    assert capsys.readouterr().out == "-k*phi p*cos(phi)\n"


@pytest.mark.parametrize(
    ("statement", "printed"),
    [
        ("print(diff(phi(t),t));", "p\n"),
        ("for k to 2 do diff(sin(k*phi(t)),t) end do;", "p*cos(phi)\n2*p*cos(2*phi)\n"),
    ],
)
@pytest.mark.parametrize(
    "rule", [RULE, RULE.replace("proc(t) p(t)", "proc(e, v) if v = t then p(t) else 0 end if")]
)
def test_a_rate_that_has_a_rule_is_never_printed(
    rule: str, statement: str, printed: str, capsys: pytest.CaptureFixture[str]
) -> None:
    program = made(rule + statement)
    assert (program.values, program.left_out) == (1, int(rule != RULE))
    exec(program.text, {})
    assert capsys.readouterr().out == printed


@pytest.mark.parametrize(
    "text",
    ["make_POINT(T, a, 0, b)", "make_VECTOR(T, a, 0, b)", "make_BODY(T, m, A, B, C)"],
)
@pytest.mark.parametrize("option", ["", ", 'synthetic'"])
def test_shown_objects_are_compared_field_by_field(text: str, option: str) -> None:
    interpreter = Interpreter(Session())
    sheet = f"with(MBSymba_r6): T := rotate('Z',theta(t)): show({text}{option});"
    for cell in source_cells(sheet):
        for statement in statements(cell):
            interpreter.execute(statement)  # type: ignore[arg-type]
    a, b, m, *inertia = sb.symbols("a b m A B C")
    T = sb.rotate("Z", sb.functions_of_time("theta"))
    right, other = {
        "make_P": (sb.Point(T, a, 0, b), sb.Point(T, a, 0, 2 * b)),
        "make_V": (sb.Vector(T, a, 0, b), sb.Vector(T, b, 0, a)),
        "make_B": (sb.Body(T, m, *inertia), sb.Body(T, 2 * m, *inertia)),
    }[text[:6]]
    session = interpreter.session
    assert same(session, right, session.last[0])
    assert not same(session, other, session.last[0])
