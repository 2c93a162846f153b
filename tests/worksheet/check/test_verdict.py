"""Which output of the file belongs to which statement, and the verdict on it."""

from __future__ import annotations

import pytest

from symbody.worksheet.check import Verdict, verdicts
from symbody.worksheet.interpreter.interpret import Interpreter
from symbody.worksheet.reading.files import source_cells
from symbody.worksheet.reading.two_dimensions import is_layout
from symbody.worksheet.run import outcomes


def check(text: str) -> list[Verdict]:
    cells = source_cells(text)
    return verdicts(cells, list(outcomes(cells, Interpreter())))


def test_each_statement_has_a_verdict() -> None:
    text = "> a := x+x;\n\na := 2*x\n\n> b := a^2;\n\nb := 3*x^2\n\n> c := 1;\n\nc := ...\n"
    assert check(text) == [
        Verdict(1, "equal"),
        Verdict(5, "differs", "the file has 3*x^2, the run 4*x^2"),
        Verdict(9, "not comparable", "cut before anything complete"),
    ]


def test_outputs_can_stand_further_down() -> None:
    text = "> a := 1: b := 2;\n\n> c := 3;\n\nof it\n\n> d := 4:\n\nb := 2\n\nc := 3\n"
    assert [(one.line, one.kind) for one in check(text)] == [(1, "equal"), (3, "equal")]


def test_tables_have_no_order() -> None:
    text = "> T := table([a=x, b=y]): entries(T), [indices(T, 'nolist')];\n\n[y], [x], [b, a]\n"
    kinds = [
        check(text),
        check(text.replace("[y]", "[z]")),
        check(text.replace("entries(T), ", "").replace("[y], [x], ", "")),
    ]
    order = "in another order, since tables have none"
    assert [(one.kind, one.reason) for (one,) in kinds] == [
        ("equal", order),
        ("differs", "[1] [1] the file has z, the run x"),
        ("equal", order),
    ]


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


def test_centred_outputs_below_each_other_are_compared() -> None:
    """As Maple exports them: each in the middle of the page, without empty lines."""
    text = "> v := [1,2,3]; v[2];\n" + "\n".join(each.center(78) for each in ("v := [1, 2, 3]", "3"))
    text += "\n> for i to 3 do i^2 od;\n" + "\n".join(f"{'':36}{each}" for each in (1, 4, 8)) + "\n> a;\n"
    assert [str(verdict) for verdict in check(text)] == [
        "equal",
        "differs: the file has 3, the run 2",
        "differs: the file has 8, the run 9; 1 of 3 outputs",
    ]


@pytest.mark.parametrize(
    "formula", ["           2\n     a := x  + 1", "     a + b\n     -----\n       c", "   2\n  x"]
)
def test_formulas_in_two_dimensions_are_no_outputs_of_several_statements(formula: str) -> None:
    indented = "\n".join(f"          {line}" for line in formula.split("\n"))
    assert is_layout(indented)


def test_rates_and_lines_in_two_dimensions_have_a_verdict() -> None:
    text = """> PDEtools[declare](prime=t, quiet): diff(x(t),t);

`z'`

> W := 3*x(t);
                             W := 4 x(t)
> v := <1,2>;

v := Vector[column](%id = 18446744078)

> 3;

3
"""
    assert [str(verdict) for verdict in check(text)] == [
        "differs: the file has diff(z(t),t), the run diff(x(t),t)",
        "differs: the file has 4*x(t), the run 3*x(t)",
        "not comparable: a matrix in it is not printed in full",
        "equal",
    ]
