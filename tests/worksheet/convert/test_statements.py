"""Statements whose program hung, was lost, or was other than the worksheet."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any

import pytest

from symbody.worksheet.convert import convert_file
from symbody.worksheet.convert.program import Converted, converted
from symbody.worksheet.reading.files import source_cells


def made(text: str) -> tuple[Converted, dict[str, Any]]:
    program, values = converted(source_cells(text), "statements"), dict[str, Any]()
    exec(program.text, values)
    return program, values


@pytest.mark.parametrize(
    ("head", "total"),
    [
        ("for i while i < 4", 1 + 2 + 3),
        ("for i from -1 while i < 2", -1 + 0 + 1),
        ("for i by 2 while i < 6", 1 + 3 + 5),
        ("for i from 5 by -2 while i > 0", 5 + 3 + 1),
        ("for i to 9 while i < 3", 1 + 2),
    ],
)
def test_loops_that_a_condition_ends_count(head: str, total: int) -> None:
    program, values = made(f"i := -7: s := 0: {head} do s := s + i end do: f := s:")
    assert (program.values, program.left_out) == (0, 0)
    assert values["f"] == total


def test_modules_of_the_program_outlive_a_restart() -> None:
    text = (
        "restart: P := proc(n) option remember; n + 1 end: a := P(3): "
        "s := 0: for i while i < 3 do s := s + i end do:"
    )
    program, values = made(text)
    assert (program.values, program.left_out) == (0, 0)
    assert (values["a"], values["s"]) == (4, 3)
    assert "@functools.cache\ndef P(n):" in program.text


def test_names_of_modules_are_variables_of_the_worksheet() -> None:
    _, values = made("Path := 3: itertools := 4: pickle := Path + itertools: s := pickle:")
    assert values["s"] == 7


def test_statements_that_fail_are_counted(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    sheet = tmp_path / "a.mpl"
    sheet.write_text("P := proc(x::posint) x end:\nP(0);\ny := 2;\n", encoding="utf-8")
    assert convert_file(argparse.Namespace(file=sheet, program=tmp_path / "a.py")) == 1
    assert capsys.readouterr().out == "2 statements written as code, 0 as values, 0 left out, 1 failed\n"


def test_cases_of_values_declare_no_truth() -> None:
    program, values = made("z := piecewise(x < 1, 2, 3);")
    assert "True_" not in program.text
    assert values["z"].subs({values["x"]: 0}) == 2
    assert values["z"].subs({values["x"]: 4}) == 3


def test_formats_have_texts_and_numbers(capsys: pytest.CaptureFixture[str]) -> None:
    program, _ = made(
        r'for i to 2 do printf("%s = %+06.3f%% of %a\n", cat("F", i), evalf(i*Pi), x + i) end do;'
    )
    assert (program.values, program.left_out) == (0, 0)
    assert capsys.readouterr().out == "F1 = +3.142% of x + 1\nF2 = +6.283% of x + 2\n"
