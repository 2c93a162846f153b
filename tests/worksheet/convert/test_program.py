"""The Python program of a worksheet runs, and gives what the worksheet gives."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any

import pytest

import symbody as sb
from symbody.worksheet.convert import convert_file
from symbody.worksheet.convert.program import program
from symbody.worksheet.convert.same import same
from symbody.worksheet.interpret import Interpreter
from symbody.worksheet.reading import names_in_code, read_source, statements
from symbody.worksheet.reading.files import source_cells
from symbody.worksheet.session import Session
from symbody.worksheet.source import Cell, Remark, SyntaxMistake

VALID = Path(__file__).parents[2] / "worksheets" / "valid"


def run(text: str) -> dict[str, Any]:
    values: dict[str, Any] = {}
    exec(text, values)
    return values


def session_of(cells: tuple[Cell, ...]) -> Session:
    interpreter = Interpreter()
    used = names_in_code(cells)
    for cell in cells:
        for statement in statements(cell, used):
            if not isinstance(statement, Remark | SyntaxMistake):
                interpreter.execute(statement)
    return interpreter.session


SHEETS = [
    ("pendulum_newton.mpl", ["T1", "G", "bob", "pin", "eqnsN", "eqnsE", "eq", "R", "T", "V", "eqL"]),
    ("slider_crank.mpl", []),
    ("four_bar.mpl", ["T1", "crank", "phi__loop", "vel"]),
    ("spherical_joints.mpl", ["link1", "link2", "N2", "E1"]),
    ("objects_and_copies.mpl", ["B1", "P", "Q", "v", "w", "n"]),
    ("cam_follower.mpl", ["cam", "follower", "C", "V__c", "V__m"]),
    ("late_values.mpl", []),
]


@pytest.mark.parametrize(("sheet", "names"), SHEETS, ids=[sheet for sheet, _ in SHEETS])
def test_programs_give_what_the_sheets_give(
    sheet: str, names: list[str], capsys: pytest.CaptureFixture[str]
) -> None:
    cells = read_source(VALID / sheet)
    values, session = run(program(cells, sheet)), session_of(cells)
    assert all(name in values for name in names)
    # What is left out stays a symbol.
    checked = [name for name in session.names if name in values and str(values[name]) != name]
    assert len(checked) >= len(names)
    assert [name for name in checked if not same(session, values[name], session.names[name])] == []


def test_a_program_reads_as_one_would_write_it() -> None:
    sheet = """restart: with(MBSymba_r6):
T := translate(x(t), 0, 0):
b := make_BODY(T, m):
_gravity := make_VECTOR(ground, 0, -g, 0):
E1 := newton_equations({b}):
F := comp_X(E1);
"""
    text = program(source_cells(sheet), "slide")
    assert text == (
        '"""slide, converted from a worksheet of MBSymba."""\n\nimport symbody as sb\n\n'
        'x = sb.functions_of_time("x")\nm, g = sb.symbols("m g")\n\n'
        "T = sb.translate(x, 0, 0)\nb = sb.Body(T, m)\ngravity = sb.Vector(sb.ground, 0, -g, 0)\n"
        "E1 = sb.newton_equations([b], gravity=gravity)\nF = E1.components[0]\n"
    )


def test_a_value_that_comes_later_reaches_what_was_made_before() -> None:
    values = run(
        program(source_cells("T := rotate('Z', a):\nP := make_POINT(T, l, 0, 0):\na := w - b:\n"), "late")
    )
    w, b, l = sb.symbols("w b l")
    assert values["T"].matrix == sb.rotate("Z", w - b).matrix
    assert sb.project(values["P"], sb.ground).coordinates[0] == l * sb.cos(w - b)


def test_what_has_no_text_is_written_as_its_value() -> None:
    text = program(source_cells("f := x -> x^2:\ny := f(a) + 1;\nplot(y, a = 0..1):\n"), "values")
    assert "# left out, line 1: f := x -> x^2:" in text
    a = sb.symbols("a")
    assert run(text)["y"] == a**2 + 1


def test_the_command(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    sheet = tmp_path / "a.mpl"
    sheet.write_text("a := 2*b;\nc := (1;\n", encoding="utf-8")
    options = argparse.Namespace(file=sheet, program=tmp_path / "model.py")
    assert convert_file(options) == 1
    assert capsys.readouterr().out == "1 statements written as code, 0 as values, 0 left out\n"
    assert "# line 2 can't be read" in (tmp_path / "model.py").read_text(encoding="utf-8")
    options.file = tmp_path / "missing.mpl"
    assert convert_file(options) == 3
    assert "is not readable" in capsys.readouterr().err
