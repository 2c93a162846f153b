"""Remarks that lost their ``#``: which text among code is no code."""

from __future__ import annotations

import pytest

from symbody.worksheet.reading import statements
from symbody.worksheet.sheet.source import Cell, Line, Remark, SyntaxMistake
from symbody.worksheet.sheet.syntax import Assignment, Evaluation, For


def read(text: str, **options: bool) -> tuple[list[str], list[str]]:
    """Return the kinds of the statements and mistakes, and the remarks."""
    lines = tuple(Line(line, k) for k, line in enumerate(text.split("\n"), start=1))
    found = list(statements(Cell(lines, **options)))
    others = [type(one).__name__ for one in found if not isinstance(one, Remark)]
    return others, [one.text for one in found if isinstance(one, Remark)]


ONE, TWO = ["Evaluation"], ["Evaluation", "Assignment"]

CASES = [
    # Behind the last terminator of a line.
    ("show(AB); crank", ONE, ["crank"]),
    ("show(AB); crank\nB := 3;", TWO, ["crank"]),
    ("show(AB);  ground coordinates\nB := 3;", TWO, ["ground coordinates"]),
    ("show(AB): the wheel's axis\nB := 3;", TWO, ["the wheel's axis"]),
    ("show(AB); 'sin' and 'cos' of it\nB := 3;", TWO, ["'sin' and 'cos' of it"]),
    ('show(AB): the "first" link\nB := 3;', TWO, ['the "first" link']),
    ("show(AB); x(t), y(t), lateral displacement\nB := 3;", TWO, ["x(t), y(t), lateral displacement"]),
    ("show(AB); it moves (see the figure\nB := 3;", TWO, ["it moves (see the figure"]),
    ("show(AB); for the rear wheel\nB := 3;", TWO, ["for the rear wheel"]),
    ("show(AB); frame and body", ONE, ["frame and body"]),
    ("for i to 3 do w[i] := i^2;  squares\nod;", ["For"], ["squares"]),
    ("for i to 3 do w := i^2;  w\nod;", ["For"], []),
    ("a := b^2: square of it; c := 4;", ["Assignment", "Assignment"], ["square of it;"]),
    ("f := sin(q)  (sine of q)\n;\nB := 3;", ["Assignment"] * 2, ["(sine of q)"]),
    ("f := sin(q) (sine of q)(t);", ["SyntaxMistake"], []),
    ("f := sin(q)(sine of q);", ["SyntaxMistake"], []),
    ("y := x1 + the offset\n x2; B := 3;", ["Assignment"] * 2, ["the offset"]),
    ("y := x1 + the offset;", ["SyntaxMistake"], []),
    ("!ls\nB := 3;", ["SyntaxMistake", "Assignment"], []),
    # It isn't one where it is complete, or where the next line completes it.
    ("show(AB); crank;", ["Evaluation", "Evaluation"], []),
    ("show(AB); B := [x,\ny];", TWO, []),
    ("show(AB); B := 3", TWO, []),
    ("show(AB); show(B)", ["Evaluation", "Evaluation"], []),
    # Behind a comma, and on lines of its own in an open bracket.
    ("q := [x(t), lateral\n y(t)];", ["Assignment"], ["lateral"]),
    ("q := [x(t),\n the first of the coordinates\n y(t)];", ["Assignment"], ["the first of the coordinates"]),
    ("q := [x(t), lateral, of the vehicle\n y(t)];", ["Assignment"], ["lateral, of the vehicle"]),
    ("q := [x(t), z, of the vehicle\n y(t)]: z := 1;", ["Assignment"] * 2, ["of the vehicle"]),
    ("q := {x(t),y(t)\nplace (of the body)\n}: z := 1;", ["Assignment"] * 2, ["place (of the body)"]),
    ("for i to 3 do  all links\n i; od;", ["For"], ["all links"]),
    (
        "q := [x(t) = 0,   the first\n y(t) = 0        the second one, of them\n ]:",
        ["Assignment"],
        ["the first", "the second one, of them"],
    ),
    ("q := [x(t),\n y(t) the second\n ]:", ["Assignment"], ["the second"]),
    (
        "p := proc(a, b)   computes it\n  local x;   of the call\n  x := a;  it is\nend proc:",
        ["Assignment"],
        ["computes it", "of the call", "it is"],
    ),
    ("f(x)  the value", ["Evaluation"], ["the value"]),
    # Lines of prose among code.
    ("The energy of the plate\nB := 3;", ["Assignment"], ["The energy of the plate"]),
    ("B := 3;\nThe energy: it is kept\nshow(B);", ["Assignment", "Evaluation"], ["The energy: it is kept"]),
    # Mistakes are no remarks.
    ("a := b c;", ["SyntaxMistake"], []),
    ("show (G) hello;", ["SyntaxMistake"], []),
    ("f(a, b;\nB := 3;", ["SyntaxMistake", "Assignment"], []),
]


@pytest.mark.parametrize(("text", "kinds", "remarks"), CASES, ids=[text for text, _, _ in CASES])
def test_remarks(text: str, kinds: list[str], remarks: list[str]) -> None:
    assert read(text) == (kinds, remarks)


def test_a_mark_undoes_it() -> None:
    assert read("q := [x(t), # lateral\n y(t)];") == (["Assignment"], [])


def test_the_value_has_what_is_left() -> None:
    lines = (Line("q := [x(t), lateral, of the vehicle", 1), Line(" y(t)];", 2))
    (remark, found) = statements(Cell(lines))
    assert isinstance(found, Assignment)
    assert len(found.value.items) == 2
    assert isinstance(remark, Remark)
    assert (remark.place.line, remark.place.column) == (1, 13)


def test_where_marks_were_kept_the_end_of_a_cell_ends_a_statement() -> None:
    assert read("a := 1; a", remarks_lost_marks=False) == (["Assignment", "Evaluation"], [])
    assert read("a := 1; a") == (["Assignment"], ["a"])


def test_names_of_other_cells_are_no_remarks() -> None:
    lines = (Line("q := [x(t), lateral, of the vehicle", 1), Line(" y(t)];", 2))
    found = [one for one in statements(Cell(lines), {"lateral"}) if isinstance(one, Remark)]
    assert [one.text for one in found] == ["of the vehicle"]


@pytest.mark.parametrize("count", [400])
def test_many_mistakes_take_little_time(count: int) -> None:
    text = "{" + "\n".join("a word too much" for _ in range(count))
    found = list(statements(Cell(tuple(Line(line, k) for k, line in enumerate(text.split("\n"), start=1)))))
    assert 0 < len(found) <= count + 1
    loops = "\n".join("for i to 3 do a;" for _ in range(count))
    found = list(statements(Cell(tuple(Line(line, k) for k, line in enumerate(loops.split("\n"), start=1)))))
    assert isinstance(found[-1], SyntaxMistake | Evaluation | For)
