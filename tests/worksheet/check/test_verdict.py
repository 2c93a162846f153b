"""Which output of the file belongs to which statement, and the verdict on it."""

from __future__ import annotations

from symbody.worksheet.check import Verdict, verdicts
from symbody.worksheet.interpreter.interpret import Interpreter
from symbody.worksheet.reading.files import source_cells
from symbody.worksheet.run import outcomes


def check(text: str) -> list[Verdict]:
    cells = source_cells(text)
    return verdicts(cells, list(outcomes(cells, Interpreter())))


def test_each_statement_has_a_verdict() -> None:
    text = "> a := x+x;\n\na := 2*x\n\n> b := a^2;\n\nb := 3*x^2\n\n> c := 1;\n\nc := ...\n"
    assert check(text) == [
        Verdict(1, "equal"),
        Verdict(5, "differs", "the file has 3*x**2, the run 4*x**2"),
        Verdict(9, "not comparable", "cut before anything complete"),
    ]


def test_outputs_can_stand_further_down() -> None:
    text = "> a := 1: b := 2;\n\n> c := 3;\n\nof it\n\n> d := 4:\n\nb := 2\n\nc := 3\n"
    assert [(one.line, one.kind) for one in check(text)] == [(1, "equal"), (3, "equal")]


def test_loops_over_sets_have_no_order() -> None:
    text = "> s := {x^2+1, y-3}:\n> for i to 2 do i, s[i]; od;\n\n1, y-3\n\n2, x^2+1\n"
    (verdict,) = check(text)
    assert (verdict.kind, verdict.line) == ("equal", 2)
    swapped = text.replace("1, y-3\n\n2, x^2+1", "1, x^2+1\n\n2, y-3")
    assert check(swapped)[0].kind == "equal"


def test_pictures_and_missing_outputs() -> None:
    text = "> plain(1);\n\n[Maple Plot]\n\n> x := 3:\n\nx := 3\n"
    assert [verdict.reason for verdict in check(text)] == [
        "a picture, or in Maple's own encoding",
        "the run printed nothing for it: x := 3",
    ]


def test_counts_depend_on_the_form() -> None:
    (verdict,) = check("> nops(a+b+c);\n\n4\n")
    assert verdict == Verdict(
        1, "not comparable", "a count, which depends on the form: the file has 4, the run 3"
    )
