"""Sums of objects that have no meaning are told, and cells that follow other text in a line are read."""

from __future__ import annotations

from symbody.worksheet.interpreter.interpret import Interpreter
from symbody.worksheet.reading.files import source_cells
from tests.worksheet.printed_by import failures, printed

BODIES = """with(MBSymba_r6): A := make_BODY(translate(x(t),0,0)*rotate('Z',q(t)),m,0,0,J):
B := make_BODY(translate(y(t),0,0),m): v := make_VECTOR(ground,f,h,0):
"""


def notes(text: str) -> list[str]:
    """Return the notes of the last statement of a sheet."""
    interpreter = Interpreter()
    printed(text, interpreter=interpreter)
    return interpreter.session.notices


def test_what_has_no_meaning_of_named_objects_stays_with_a_note() -> None:
    (note,) = notes(BODIES + "P := CoM(A): R := CoM(B): P + R;")
    assert note.startswith("POINT P + POINT R has no meaning and stays as it is; expected a POINT + a VECTOR")
    assert printed(BODIES + "P := CoM(A): R := CoM(B): P + R;")[-1] == "P+R"
    (error,) = failures(BODIES + "CoM(A) + CoM(B);")
    assert error.startswith("a POINT + a POINT has no meaning")
    assert failures(BODIES + "diff(v,t); coeff(v,h); series(v,h);") == [
        f"{command}: v is a VECTOR; expected an expression: comp_XYZ(v) are the components of a VECTOR, velocity(v) is "
        "its derivative"
        for command in ("diff", "coeff", "series")
    ]
    assert [each.split(" has")[0] for each in failures(BODIES + "T := rotate('X',1): T*v; v.T; T*A;")] == [
        "a matrix * VECTOR v",
        "VECTOR v . a matrix",
        "a matrix * BODY A",
    ]


def test_appended_cells_begin_behind_other_text() -> None:
    for end in ("a := 1;", "> a := 1;\n\na := 1", "> a := f(x);\n\na := f...", "some words"):
        cells = source_cells(f"{end}> b := 2;\n> c := 3;\n")
        assert [line.text.strip() for cell in cells for line in cell.input][-2:] == ["b := 2;", "c := 3;"]


def test_a_comparison_and_a_text_hold_no_prompt() -> None:
    text = '> if a> b then c := 2 fi;\n> printf("x;> y := %d", 3);\n'
    assert printed("> a := 1: b := 3:\n" + text)[-1] == "x;> y := 3"
