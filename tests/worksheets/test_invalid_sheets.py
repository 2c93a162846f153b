"""Worksheets with a mistake: its place, what was expected, and the next statement runs."""

from __future__ import annotations

import argparse
from pathlib import Path

import pytest

from symbody.__main__ import add_run_options
from symbody.worksheet.run import run_file

INVALID = Path(__file__).parent / "invalid"
MESSAGES = {
    "division_by_zero": (1, 6, "division by zero"),
    "file_outside": (1, 1, "'../outside.txt' is not inside the output folder"),
    "force_on_a_point": (3, 6, "make_FORCE: a POINT; expected a body on which it acts"),
    "force_without_body": (3, 6, "make_FORCE: expected make_FORCE(vector, point, body) or"),
    "frame_that_is_not_rigid": (2, 15, "the rotation part isn't rigid"),
    "index_out_of_range": (1, 15, "the index 4 is out of range; expected one from 1 to 3"),
    "inertia_that_is_not_symmetric": (3, 6, "its entry 2, 1 is 4, and its entry 1, 2 is 2"),
    "initial_values_missing_numbers": (1, 6, "dsolve: no value is known of k"),
    "mass_that_changes": (3, 6, "the mass of a BODY is m(t), which depends on time"),
    "matrices_of_other_sizes": (1, 6, "the product of matrices of 2 x 2 and 3 x 3"),
    "missing_bracket": (1, 12, "found ';', expected an operator"),
    "moving_frame_of_three": (2, 1, "use_moving_frame: expected six velocities"),
    "newton_without_bodies": (3, 6, "newton_equations: no body in the system"),
    "no_closed_form": (1, 6, "solve: no solution in closed form of 1 equation in x"),
    "not_a_frame": (2, 6, "origin: T is a list; expected a frame"),
    "point_of_two_coordinates": (2, 6, "make_POINT: 2 components; expected three"),
    "recursive_name": (1, 1, "recursive assignment"),
    "small_variables_that_are_none": (2, 1, "linear_modeling: x(t)^2 is not a variable"),
    "sum_of_points": (2, 6, "a POINT + a POINT has no meaning; expected a POINT + a VECTOR"),
    "system_commands": (1, 1, "a worksheet can't run commands of the system"),
    "too_few_equations": (2, 9, "state_space: 1 equation for the rates of 2 states"),
    "two_names": (1, 8, "found 'b', expected an operator"),
    "unbalanced_end": (2, 8, "the statement is not complete"),
    "unknown_axis": (2, 6, "rotate: the axis W; expected 'X', 'Y', 'Z' or a VECTOR"),
}


@pytest.mark.parametrize("path", sorted(INVALID.iterdir()), ids=lambda path: path.stem)
def test_mistakes_are_located_and_the_sheet_goes_on(
    path: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    line, column, message = MESSAGES[path.stem]
    parser = argparse.ArgumentParser()
    add_run_options(parser)
    status = run_file(parser.parse_args([str(path), "--out", str(tmp_path)]))
    printed = capsys.readouterr().out
    assert status == 1
    assert f"Error, line {line}, column {column}: " in printed
    assert message in printed
    assert f"\n  {' ' * (column - 1)}^\n" in printed
    assert "\ny := 2\n" in printed
    assert " statements, 1 failed, " in printed
    assert [*tmp_path.iterdir()] == []
