"""Notes about objects that may not be what a sheet means: forces beside their bodies, sums without a meaning."""

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


def test_a_force_at_a_place_that_its_body_leaves_is_told() -> None:
    made = "F := make_FORCE(v, make_POINT(ground,l,0,0), A): newton_equations({A,B,F}):"
    (note,) = notes(BODIES + made)
    assert note.startswith(
        "the FORCE F acts on A at a place at rest, from which A moves away; expected a point of A"
    )
    (other,) = notes(BODIES + "F := make_FORCE(v, CoM(B), A): newton_equations({A,B,F}):")
    assert "at a place on B" in other


def test_a_force_at_a_point_of_one_of_its_bodies_needs_no_note() -> None:
    assert notes(BODIES + "F := make_FORCE(v, CoM(B), A, B): newton_equations({A,B,F}):") == []
    assert notes(BODIES + "F := make_FORCE(v, make_POINT(A[frame],l,0,0), A): newton_equations({A,F}):") == []


def test_what_has_no_meaning_of_named_objects_stays_with_a_note() -> None:
    (note,) = notes(BODIES + "P := CoM(A): R := CoM(B): P + R;")
    assert note.startswith("POINT P + POINT R has no meaning and stays as it is; expected a POINT + a VECTOR")
    assert printed(BODIES + "P := CoM(A): R := CoM(B): P + R;")[-1] == "P+R"
    (error,) = failures(BODIES + "CoM(A) + CoM(B);")
    assert error.startswith("a POINT + a POINT has no meaning")


def test_appended_cells_begin_behind_other_text() -> None:
    for end in ("a := 1;", "> a := 1;\n\na := 1", "> a := f(x);\n\na := f...", "some words"):
        cells = source_cells(f"{end}> b := 2;\n> c := 3;\n")
        assert [line.text.strip() for cell in cells for line in cell.input][-2:] == ["b := 2;", "c := 3;"]


def test_a_comparison_and_a_text_hold_no_prompt() -> None:
    text = '> if a> b then c := 2 fi;\n> printf("x;> y := %d", 3);\n'
    assert printed("> a := 1: b := 3:\n" + text)[-1] == "x;> y := 3"
