"""Behind a mistake, reading goes on with the next statement, whatever was left open."""

from __future__ import annotations

from html import escape

import pytest

from symbody.worksheet.reading import names_in_code, statements
from symbody.worksheet.reading.files import source_cells
from symbody.worksheet.sheet.source import Remark, SyntaxMistake

#: Statements with something open, that nothing closes.
OPEN = [
    "q := [x(t), (m) lateral",
    "q := [x(t), y(t)",
    "q := [x(t),",
    "q := {x(t), y(t)}];",
    "q := f(x,\n  g(y)",
    "q := a*(b +",
    "q := a[1",
    "q := <a, b",
    "q := <a, b;",
    "q := 'show",
    "q := '",
    'q := "a text; with code := 2; ',
    "q := `a name; with code := 2",
    "q := (a + b;",
    "q := 2 3",
    "if x > 1 then y := 2; fi fi",
    "q := proc(a) a^2 end end",
    "(* not closed",
]

#: Statements that begin on the next line; with a prompt, or in any file.
PROMPTED = ["last;", "show(last, 'synthetic');", "[last, 2];", "last := 1", "last + 1;"]
ANYWHERE = [
    "last := 1;",
    "last[1], last(t) := f(\n  2);",
    "(last, b) := f(2);",
    "`last` := 1:",
    "'last' := 1:",
    "for i to 3 do last(i) od;",
    "lambda||2 := last;",
    "last := proc(a := 1) a end;",
]


def ends(text: str) -> list[tuple[bool, int]]:
    """Return of each statement whether it can be read, and the line on which it ends."""
    cells = source_cells(text)
    used = names_in_code(cells)
    found = [each for cell in cells for each in statements(cell, used) if not isinstance(each, Remark)]
    return [(not isinstance(each, SyntaxMistake), each.place.end_line) for each in found]


def check(text: str, last: int) -> None:
    """Check that the statements on the last two lines, and the one on the first, are read, and that one isn't."""
    found = ends(text)
    assert found[0] == (True, 1)
    assert found[-2:] == [(True, last - 1), (True, last)]
    assert False in [is_read for is_read, _ in found]


@pytest.mark.parametrize("text", OPEN)
def test_the_statement_at_the_next_prompt_is_read(text: str) -> None:
    for following in PROMPTED + ANYWHERE:
        for gap in ("\n", "\n\n"):  # within a cell, and in the next one
            sheet = f"> first := 1;\n> {text}{gap}> {following}\n> behind := 1;"
            check(sheet, sheet.count("\n") + 1)


@pytest.mark.parametrize("text", OPEN)
def test_the_next_assignment_is_read_without_prompts(text: str) -> None:
    for following in ANYWHERE:
        sheet = f"first := 1;\n{text}\n{following}\nbehind := 1;"
        check(sheet, sheet.count("\n") + 1)


@pytest.mark.parametrize("text", OPEN)
def test_the_end_of_a_field_ends_what_is_open(text: str) -> None:
    fields = "".join(
        f'<Group><Input><Text-field style="Maple Input" layout="Normal">{escape(each)}</Text-field></Input></Group>'
        for each in ("first := 1;", text, "last;", "behind := 1;")
    )
    found = ends(f"<?xml version='1.0'?><Worksheet>{fields}</Worksheet>")
    assert [is_read for is_read, _ in found[-2:]] == [True, True]
    assert [is_read for is_read, _ in found].count(True) == 3


def test_a_line_that_goes_on_with_a_mistake_is_no_statement() -> None:
    for text in (
        "q := [2 3,\n>  y = 2, z = 3];",
        "V := 2 3\n>   + z3;",
        "f := proc(x)\n> y := 2 3;\n> y end;",
    ):
        found = ends(f"> {text}\n> last;")
        assert [is_read for is_read, _ in found] == [False, True]


def test_what_is_missing_is_told_before_the_next_statement() -> None:
    cells = source_cells("> q := [x(t), y(t)\n> last := 1;")
    mistake, following = (each for cell in cells for each in statements(cell))
    assert isinstance(mistake, SyntaxMistake)
    assert mistake.message == (
        "line 1, column 19: the statement is not complete, expected an operator, ',' or ']'\n"
        "  q := [x(t), y(t)\n                  ^"
    )
    assert following.place.line == 2


def test_a_cell_of_mistakes_is_given_up_and_says_so() -> None:
    (cell,) = source_cells("\n".join(["> b", "> ("] * 300))
    *_, last = statements(cell)
    assert isinstance(last, SyntaxMistake)
    assert last.message == (
        f"line {last.place.line}, column 3: there are too many mistakes before this statement: neither it nor the"
        " rest of this cell is read\n  b\n  ^"
    )
