"""Remarks that lost their ``#``: which text among code is no code."""

from __future__ import annotations

import pytest

from symbody.worksheet.reading import names_in_code, statements
from symbody.worksheet.reading.text_export import text_export_cells
from symbody.worksheet.sheet.source import Cell, Line, Remark, SyntaxMistake
from symbody.worksheet.sheet.syntax import Assignment, Evaluation, For
from tests.worksheet.printed_by import printed


def read(text: str, **options: bool) -> tuple[list[str], list[str]]:
    """Return the kinds of the statements and mistakes, and the remarks."""
    lines = tuple(Line(line, k) for k, line in enumerate(text.split("\n"), start=1))
    cell = Cell(lines, **options)
    found = list(statements(cell, names_in_code([cell])))
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
    # Behind a comma, before a terminator; and above a line that goes on.
    ("total := d + e, all together;", ["Assignment"], [", all together"]),
    ("f(x), g(x), both of them: B := 3;", TWO, [", both of them"]),
    ("total := d + e, f d;", ["SyntaxMistake"], []),
    ("s := a    -> forward\n + b;", ["Assignment"], ["-> forward"]),
    ("s := a    -> forward\n + a*b;", ["Assignment"], []),
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
    # Behind code: the code stays.
    ("V := K/2*(x^2 +  spring in x\n y^2);", ["Assignment"], ["spring in x"]),
    (
        "V := K/2*(x^2 + spring in x\n y^2 + another in y\n z^2);",
        ["Assignment"],
        ["spring in x", "another in y"],
    ),
    ("V := K/2*(x(t)^2 + z(t)^2  springs\n + y(t)^2);", ["Assignment"], ["springs"]),
    ("V := K*x^2 +  spring in x\n K*y^2;", ["Assignment"], ["spring in x"]),
    ("e := f(a, b^2  the force\n + c, d);", ["Assignment"], ["the force"]),
    ("e := [a + b +  offset here\n c, d];", ["Assignment"], ["offset here"]),
    ("F := f(T, 0, -m*g  weight,\n 0, P, b);", ["Assignment"], ["weight"]),
    ("S := {b1,  the arm\n  b2  the link\n}:", ["Assignment"], ["the arm", "the link"]),
    ("S := {b1, b2 the link\n}: b2 := 2:", ["Assignment"] * 2, ["the link"]),
    ("e := m*a + inertia\n c*v;", ["SyntaxMistake"], []),
    (
        "e := m*a +   inertia\n c*v +  damping\n k*x;  stiffness",
        ["Assignment"],
        ["inertia", "damping", "stiffness"],
    ),
    ("e := m*a -   inertia\n F(t)   drive force\n + k*x;", ["Assignment"], ["inertia", "drive force"]),
    ("e := x +   y\n z*y;", ["SyntaxMistake"], []),
    ("V := K/2*(x^2 + 2 y\n + z^2);", ["SyntaxMistake"], []),
    ("V := K/2*(x^2 + y\n z^2);", ["SyntaxMistake"], []),
    ("e := [a, b^2  the force\n c];", ["SyntaxMistake"], []),
    ("e := [a + b  offset here\n c, d];", ["SyntaxMistake"], []),
    ("m := [[1,2],  2nd row\n [3,4]];", ["Assignment"], ["2nd row"]),
    ("m := [[1,2],  first\n [3,4]];", ["Assignment"], ["first"]),
    ("q := [x(t), (m) lateral\n y(t)];", ["Assignment"], ["(m) lateral"]),
    ("q := [x(t), [m/s] rate, of the car\n y(t)];", ["Assignment"], ["[m/s] rate, of the car"]),
    ("q := [x(t), (m) k];", ["SyntaxMistake"], []),
    ("q := [x, y,  [m]\n phi  (rad)\n ];", ["Assignment"], ["[m]", "(rad)"]),
    ("F := k*(x - x0  deflection [m]\n ) + c*v;", ["Assignment"], ["deflection [m]"]),
    ("s := a * not used\n + b;", ["SyntaxMistake"], []),
    ("if x > 1 [m/s^2]\n then y := 2 fi;", ["If"], ["[m/s^2]"]),
    ("T := f(A, B) = mass of the car\n;", ["Assignment"], ["= mass of the car"]),
    # Behind the last terminator, with names of the code.
    ("x := 3; x coordinate of G\ny := 4;", ["Assignment"] * 2, ["x coordinate of G"]),
    ("x := 3: unit: N/m\ny := 4;", ["Assignment"] * 2, ["unit: N/m"]),
    ("m := 3; m [kg]\n(a, b) := f(m);", ["Assignment"] * 2, ["m [kg]"]),
    ("for i to 3 do w[i] := i^2;  [mm]\nod;", ["For"], ["[mm]"]),
    ("f := proc(x) local y; y := x^2; y\nend proc;", ["Assignment"], []),
    # Lines of their own between statements.
    ("x := 3:\n  length, width and height\ny, z := f(x);", ["Assignment"] * 2, ["length, width and height"]),
    ("x := 3:\n  [m/s^2]\ny := 4;", ["Assignment"] * 2, ["[m/s^2]"]),
    ("x := 3:\n  from the 2nd link\ny := 4;", ["Assignment"] * 2, ["from the 2nd link"]),
    ("x := 3:\n  x + 1\ny := 4;", ["Assignment", "SyntaxMistake", "Assignment"], []),
    # Lines of prose among code.
    ("The energy of the plate\nB := 3;", ["Assignment"], ["The energy of the plate"]),
    ("B := 3;\nThe energy: it is kept\nshow(B);", ["Assignment", "Evaluation"], ["The energy: it is kept"]),
    ("rod 1\nB := 3;", ["Assignment"], ["rod 1"]),
    ("link 2: the coupler\nB := 3;", ["Assignment"], ["link 2: the coupler"]),
    ("1st part\nB := 3;", ["Assignment"], ["1st part"]),
    ("step 2 (see above)", [], ["step 2 (see above)"]),
    ("2 wheels in all\nB := 3;", ["Assignment"], ["2 wheels in all"]),
    # Mistakes are no remarks.
    ("rod 1\nrod := 3;", ["SyntaxMistake", "Assignment"], []),
    ("rod 1;", ["SyntaxMistake"], []),
    ("n 1: B", ["SyntaxMistake"], ["B"]),
    ("2 x", ["SyntaxMistake"], []),
    ("rod 2*a", ["SyntaxMistake"], []),
    ("a := b c;", ["SyntaxMistake"], []),
    ("show (G) hello;", ["SyntaxMistake"], []),
    ("f(a, b;\nB := 3;", ["SyntaxMistake", "Assignment"], []),
]


@pytest.mark.parametrize(("text", "kinds", "remarks"), CASES, ids=[text for text, _, _ in CASES])
def test_remarks(text: str, kinds: list[str], remarks: list[str]) -> None:
    assert read(text) == (kinds, remarks)


EXPORTS = [
    (
        "> p := [m = 2, mass (kg)\n k = 100, stiffness (N/m)\n c = 3]; damping\n> q := [x(t), y (t)];",
        ["Assignment", "Assignment"],
        ["mass (kg)", "stiffness (N/m)", "damping"],
    ),
    ("> e := m*a +   inertia\n  c*v;  damping\n> e;", ["Assignment", "Evaluation"], ["inertia", "damping"]),
    (
        "> e := m*a +   inertia\n\n  c*v;  damping\n\n> e;",
        ["Assignment", "Evaluation"],
        ["inertia", "damping"],
    ),
    (
        "> e := m*a + inertia\n  c*v +  damping\n  k*x; stiff\n> e;",
        ["SyntaxMistake", "Evaluation"],
        ["damping", "stiff"],
    ),
    ("> e := x^2\n\ne := x^2\n\nThe result: 3*k; none\n\n> e;", ["Assignment", "Evaluation"], []),
]


@pytest.mark.parametrize(("text", "kinds", "remarks"), EXPORTS, ids=[text for text, _, _ in EXPORTS])
def test_no_line_with_a_terminator_is_lost(text: str, kinds: list[str], remarks: list[str]) -> None:
    cells = text_export_cells(text)
    found = [one for cell in cells for one in statements(cell, names_in_code(cells))]
    assert [type(one).__name__ for one in found if not isinstance(one, Remark)] == kinds
    assert [one.text for one in found if isinstance(one, Remark)] == remarks


def test_a_mark_undoes_it() -> None:
    assert read("q := [x(t), # lateral\n y(t)];") == (["Assignment"], [])


def test_the_value_has_what_is_left() -> None:
    lines = (Line("q := [x(t), lateral, of the vehicle", 1), Line(" y(t)];", 2))
    (remark, found) = statements(Cell(lines))
    assert isinstance(found, Assignment)
    assert len(found.value.items) == 2
    assert isinstance(remark, Remark)
    assert (remark.place.line, remark.place.column) == (1, 13)


def test_terms_before_a_remark_stay() -> None:
    assert printed("V := K/2*(x^2 +  spring in x\n y^2); f(a, b^2  the force\n + c, d);") == [
        "V := 1/2*K*(x^2+y^2)",
        "f(a,b^2+c,d)",
    ]


PROMPTS = [
    ("mass [kg]", "> b := 7:", ["Assignment"] * 2, ["mass [kg]"]),
    ("[N/m]", "> b := 7:", ["Assignment"] * 2, ["[N/m]"]),
    ("{kg}", "> b := 7:", ["Assignment"] * 2, ["{kg}"]),
    ("mass, kg [1]", "> b := 7:", ["Assignment"] * 2, ["mass, kg [1]"]),
    ("mass,\n> kg [1]", "> b := 7:", ["Assignment"] * 2, ["mass, kg [1]"]),
    ("x-equation, see [1], p. 23", "> eqs[3];", TWO[::-1], ["x-equation, see [1], p. 23"]),
    ("see [1]", "> [b, a];", TWO[::-1], ["see [1]"]),
    ("mass [kg", "> b := 7:", ["Assignment"] * 2, ["mass [kg"]),
    ("show(T)", "> [b];", ["Assignment", "Evaluation", "Evaluation"], []),
    # The next line completes it.
    ("q := [x,", "> y];", ["Assignment"] * 2, []),
    ("f(x,", "> y);", TWO[::-1], []),
    ("f(x)", "> + g(x);", TWO[::-1], []),
    ("f(x,", "> y;", ["Assignment", "SyntaxMistake"], []),
]


@pytest.mark.parametrize("mark", [";", ":"])
@pytest.mark.parametrize(("text", "behind", "kinds", "remarks"), PROMPTS, ids=[text for text, *_ in PROMPTS])
def test_a_unit_behind_a_terminator_leaves_the_prompts_below(
    text: str, behind: str, kinds: list[str], remarks: list[str], mark: str
) -> None:
    (cell,) = text_export_cells(f"> a := 5{mark} {text}\n{behind}\n> a + b;")
    found = list(statements(cell))
    assert [type(one).__name__ for one in found if not isinstance(one, Remark)][: len(kinds)] == kinds
    assert [one.text for one in found if isinstance(one, Remark)] == remarks
    if "SyntaxMistake" not in kinds:
        assert len(found) == len(kinds) + len(remarks) + 1


def test_what_may_be_code_is_told() -> None:
    lines = "m := 5; m [kg]", "S := {b1,  the arm", " b2, 3rd link", "b3}; mass"
    cell = Cell(tuple(Line(line, k) for k, line in enumerate(lines, start=1)))
    found = [one for one in statements(cell, names_in_code([cell])) if isinstance(one, Remark)]
    assert {one.text: one.notice for one in found} == {
        "m [kg]": "taken for a remark: m [kg]",
        "the arm": "",
        "b2, 3rd link": "taken for a remark: b2, 3rd link",
        "mass": "",
    }


def test_a_unit_that_may_be_an_item_is_told() -> None:
    lines = "m := 5; S := {b1, (m) lateral", "b2(t), (s) rate", "b3};"
    cell = Cell(tuple(Line(line, k) for k, line in enumerate(lines, start=1)))
    found = [one for one in statements(cell, names_in_code([cell])) if isinstance(one, Remark)]
    assert [one.text for one in found] == ["(m) lateral", "(s) rate"]
    assert [one.notice for one in found] == [f"taken for a remark: {one.text}" for one in found]


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
