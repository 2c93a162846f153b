"""Files to cells: text exports, Maple's XML, and files with input only."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from symbody.errors import WorksheetError
from symbody.worksheet.reading import read_source, statements
from symbody.worksheet.reading.files import source_cells
from symbody.worksheet.sheet.source import Cell, SyntaxMistake
from symbody.worksheet.sheet.syntax import Assignment, For, Statement


def code(cells: tuple[Cell, ...]) -> list[list[str]]:
    return [[line.text.strip() for line in cell.input] for cell in cells]


def kinds(cell: Cell) -> list[str]:
    return [type(found).__name__ for found in statements(cell)]


# --- text exports ---


def test_prompts_output_and_prose() -> None:
    cells = source_cells(
        "A pendulum\n\nits frame\n\n> T := rotate('Z',q(t));\n\nT := matrix([[1, 2], [3, 4]])\n\nend\n"
    )
    (cell,) = cells
    assert cell.prose == ("A pendulum", "its frame")
    assert cell.printed == ("T := matrix([[1, 2], [3, 4]])",)
    assert (cell.input[0].line, cell.input[0].column) == (5, 3)


def test_a_statement_goes_on_without_a_prompt() -> None:
    assert code(source_cells("> a := f(x,\n  y):\nb := 2:\n\n> c;\n")) == [
        ["a := f(x,", "y):", "b := 2:"],
        ["c;"],
    ]


def test_a_statement_goes_on_behind_an_empty_line_and_behind_a_prompt() -> None:
    (cell,) = source_cells("> for i to 2 do\n\n> i; od;\n\n1\n\n2\n")
    assert kinds(cell) == ["For"]
    assert cell.printed == ("1", "2")
    (other,) = source_cells("> a := f(x,\n\n  y);\n")
    assert kinds(other) == ["Assignment"]


def test_prompts_without_a_space_and_several_on_a_line() -> None:
    assert code(source_cells(">a := 1: > b := 2;\n> > c := 3;\n")) == [["a := 1:", "b := 2;", "c := 3;"]]
    (comparison,) = source_cells("> a := b > c;\n")
    assert kinds(comparison) == ["Assignment"]


def test_code_that_lost_its_prompt() -> None:
    text = """The start\n\nrestart:\n\nPDEtools[declare](prime=t, quiet):\n\nForces\n
> a := 1;\n\na := 1\n\nb := f(a, 2): show(b);
"""
    assert code(source_cells(text)) == [
        ["restart:"],
        ["PDEtools[declare](prime=t, quiet):"],
        ["a := 1;"],
        ["b := f(a, 2): show(b);"],
    ]


def test_a_bracket_stays_open_over_paragraphs_and_prose() -> None:
    (cell,) = source_cells("> s := {a,\n\nthe first body\n\nb}:\n")
    assert kinds(cell) == ["Remark", "Assignment"]
    first, second = source_cells("> s := {a,\n\nthe first body\n\n> b := 2:\n")
    assert (kinds(first), kinds(second)) == (["SyntaxMistake"], ["Assignment"])


def test_a_statement_of_several_lines_without_an_end_until_the_last() -> None:
    (cell,) = source_cells("> T := a\n+ b\n* c;\n\nT := 3\n")
    assert (kinds(cell), cell.printed) == (["Assignment"], ("T := 3",))


def test_output_directly_below_the_code() -> None:
    (cell,) = source_cells("> a := x+x;\na := 2*x\n")
    assert (kinds(cell), cell.printed) == (["Assignment"], ("a := 2*x",))
    (open_end,) = source_cells("> energy(b)\n-m*g*z\n")
    assert (kinds(open_end), open_end.printed) == (["Evaluation"], ("-m*g*z",))


def test_prose_between_lines_of_code() -> None:
    (cell,) = source_cells("> a := 1;\nthe second one\nb := 2;\n")
    assert (kinds(cell), cell.prose) == (["Assignment", "Assignment"], ("the second one",))


def test_a_mistake_in_code_without_a_prompt_is_told() -> None:
    (cell,) = source_cells("> a := 1;\nb := f(1 2);\n")
    assert kinds(cell) == ["Assignment", "SyntaxMistake"]


def test_code_that_lost_its_prompt_and_the_mark_of_its_remark() -> None:
    _, cell = source_cells("> a := 1;\n\nprose\n\nb := f(a, 2): show(b);  the body\n")
    assert kinds(cell) == ["Assignment", "Evaluation", "Remark"]


PROSE = [
    "Note:",
    "command structure:  body1 := make_BODY (point of the mass, Ix comp):",
    "Solution (numerical):",
    "The unknowns are n=12 coordinates",
    "Newton's Equations",
    "test",
    "forces and torques",
]


@pytest.mark.parametrize("line", PROSE)
def test_prose(line: str) -> None:
    first, second = source_cells(f"> a := 1;\n\n{line}\n\n> b := 2;\n")
    assert (first.printed, second.prose) == ((), (line,))


OUTPUT = [
    "12",
    "l^2, l^2",
    "1, xA(t)",
    "a = 3*x",
    "omega^2*(-1/3*3^(1/2)*(xB...",
    "[Maple Metafile]",
    "![](a.png)",
]


@pytest.mark.parametrize("line", OUTPUT)
def test_output(line: str) -> None:
    (cell, _) = source_cells(f"> a := 1;\n\n{line}\n\nprose of it\n\n> b;\n")
    assert cell.printed == (line,)


def test_an_output_that_the_export_repeats_is_one() -> None:
    (cell,) = source_cells("> a;\n\na*x+b*...\na*x+b*...\n")
    assert cell.printed == ("a*x+b*...",)


# --- input only ---


def test_a_saved_session_has_lines_broken_anywhere() -> None:
    (cell,) = source_cells("T := Matrix(4, 4, [[1,0],\n[0,1]], attributes\n = [RF]);\nlong\\\nname := 3;\n")
    found = list(statements(cell))
    assert all(isinstance(one, Assignment) for one in found)
    assert found[1].targets[0].name == "longname"


def test_all_ends_of_lines_and_encodings(tmp_path: Path) -> None:
    file = tmp_path / "a.mpl"
    file.write_bytes(b"\xef\xbb\xbfa := 1;\r\nb := 2; # caf\xc3\xa9\r")
    (cell,) = read_source(file)
    assert kinds(cell) == ["Assignment", "Assignment"]
    file.write_bytes(b"a := 1; # caf\xe9\n")
    assert kinds(read_source(file)[0]) == ["Assignment"]


# --- Maple's XML ---

MW = """<?xml version="1.0" encoding="UTF-8"?>
<Worksheet><Version major="6" minor="1"/>
<Section><Title><Text-field style="Heading 1" layout="Heading 1">A pendulum</Text-field></Title>
<Group><Input><Text-field style="Text" layout="Normal">Its frame</Text-field></Input></Group>
<Group><Input><Text-field prompt="&gt; " style="Maple Input" layout="Normal">T := rotate(&apos;Z&apos;, q(t))\
<Font style="Text">the frame; of it</Font>
 * translate(L,0,0)</Text-field></Input>
<Output><Text-field style="2D Output"><Equation style="2D Output">NiMvJSJU</Equation></Text-field></Output>
<Output><Text-field style="Line Printed Output">T = 3</Text-field>
<Text-field style="Warning">Warning, so</Text-field></Output>
</Group>
<Group><Input><Text-field style="Maple Input">a := 1; a</Text-field></Input></Group>
</Section></Worksheet>
"""


def test_mw() -> None:
    first, second = source_cells(MW)
    assert first.prose == ("A pendulum", "Its frame")
    assert first.printed == ("[Maple Math]", "T = 3", "Warning, so")
    assert (kinds(first), kinds(second)) == (["Assignment"], ["Assignment", "Evaluation"])
    assert first.input[0].line == 5


@pytest.mark.parametrize(
    "text",
    [
        MW[:-30],
        '<?xml version="1.0"?><!DOCTYPE a [<!ENTITY b "c">]><Worksheet>&b;</Worksheet>',
    ],
)
def test_xml_that_is_not_maples(text: str) -> None:
    with pytest.raises(WorksheetError, match=r"save it again as \.mw"):
        source_cells(text)


# --- the seeds ---

SEEDS = [
    folder / "shared" / "seeds" for folder in Path(__file__).parents if (folder / "shared" / "seeds").is_dir()
]


@pytest.mark.parametrize(
    ("seed", "cells", "count"), [("000_ea6b06c18f5e54f8", 30, 57), ("001_44942c621e52e3cb", 32, 58)]
)
def test_seeds(seed: str, cells: int, count: int) -> None:
    if not SEEDS:
        if "CI" in os.environ:
            pytest.fail("the folder shared/seeds is missing")
        pytest.skip("the seeds are other people's texts, and not in the repository")
    read = read_source(SEEDS[0] / f"{seed}.txt")
    found = [one for cell in read for one in statements(cell) if isinstance(one, Statement | SyntaxMistake)]
    assert not any(isinstance(one, SyntaxMistake) for one in found)
    assert (len(read), len(found)) == (cells, count)
    assert sum(isinstance(one, For) for one in found) == (3 if seed.startswith("001") else 0)


def test_a_formula_below_its_prompt_is_one_output() -> None:
    (cell,) = source_cells("> simplify(e);\n                     2\n                    l\n")
    assert [block.split() for block in cell.printed] == [["2", "l"]]


@pytest.mark.parametrize("value", ["true", "a-b", "m"])
def test_words_are_output_where_one_is_missing(value: str) -> None:
    (cell,) = source_cells(f"> is(m, a-b);\n\n{value}\n")
    assert cell.printed == (value,)
    assert source_cells(f"> is(m, a-b);\n\nfalse\n\n{value}\n")[0].printed[:1] == ("false",)
    assert source_cells("> is(m, a-b):\n\nm\n")[0].printed == ()


def test_code_that_is_executed_when_the_file_is_opened() -> None:
    cells = source_cells(
        '<Worksheet><Startup-Code startupcode="a := 3:&#xA;b := a+1:"/><Startup-Code startupcode=""/>'
        '<Group><Input><Text-field style="Maple Input">b;</Text-field></Input></Group></Worksheet>'
    )
    assert code(cells) == [["a := 3:", "b := a+1:"], ["b;"]]


def test_code_in_a_field_of_text() -> None:
    cells = source_cells(
        '<Worksheet><Group><Input><Text-field prompt="> " style="Text">so <Font executable="true" '
        'style="Maple Input">a := 3;</Font> is</Text-field></Input></Group><Group><Input><Text-field prompt="> ">'
        '<Font style="Maple Input">b := a;</Font></Text-field></Input></Group></Worksheet>'
    )
    assert code(cells) == [["a := 3;"], ["b := a;"]]
    assert cells[0].prose == ("so  is",)


def test_a_prompt_ends_a_statement_that_needs_no_more() -> None:
    (cell,) = source_cells("> restart\n> a := 3\n> b := a+1;\n> for i to 2 do\n> i;\n> od;\n> c :=\n> 4;\n")
    assert kinds(cell) == ["Evaluation", "Assignment", "Assignment", "For", "Assignment"]
