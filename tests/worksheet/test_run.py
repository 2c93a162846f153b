"""``symbody run``: what it prints, its last line, and its exit status."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from symbody.__main__ import main

GOOD = "> a := x+x;\n\na := 2*x\n\n> b := a^2:\n"


def run(tmp_path: Path, text: str, *options: str, name: str = "sheet.txt") -> int:
    (tmp_path / name).write_text(text, encoding="utf-8")
    return main(["run", str(tmp_path / name), *options])


def test_it_prints_what_maple_would_print(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(tmp_path, GOOD) == 0
    assert capsys.readouterr().out == (
        "a := 2*x\n2 statements, 0 failed, 0 compared, 0 different, 0 not comparable\n"
    )
    assert [file.name for file in tmp_path.iterdir()] == ["sheet.txt"]


def test_check(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(tmp_path, GOOD, "--check") == 0
    assert capsys.readouterr().out.splitlines()[1:] == [
        "Check, line 1: equal",
        "2 statements, 0 failed, 1 compared, 0 different, 0 not comparable",
    ]
    assert run(tmp_path, GOOD.replace("a := 2*x", "a := 3*x"), "--check", "--quiet") == 2
    assert capsys.readouterr().out.splitlines() == [
        "Check, line 1: differs: the file has 3*x, the run 2*x",
        "2 statements, 0 failed, 1 compared, 1 different, 0 not comparable",
    ]


def test_errors_end_their_statement_only(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(tmp_path, 'a := (1;\nb := 2;\nerror "no %1", b;\nc := b+1;\n') == 1
    assert capsys.readouterr().out.splitlines() == [
        "Error, line 1, column 8: found ';', expected an operator, ',' or ')'",
        "  a := (1;",
        "         ^",
        "b := 2",
        "Error, line 3, column 1: no 2",
        '  error "no %1", b;',
        "  ^",
        "c := 3",
        "4 statements, 2 failed, 0 compared, 0 different, 0 not comparable",
    ]


@pytest.mark.parametrize("name", ["missing.txt", "."])
def test_files_that_are_not_readable(name: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["run", str(tmp_path / name)]) == 3
    assert "is not readable" in capsys.readouterr().err


def test_binary_files_are_not_readable(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "sheet.mpl").write_bytes(bytes(range(256)))
    assert main(["run", str(tmp_path / "sheet.mpl")]) == 3
    assert (
        "it is no text, but a binary file; expected a worksheet as text, .mpl or .mw"
        in capsys.readouterr().err
    )


def test_xml_that_is_cut(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(tmp_path, "<?xml version='1.0'?><Worksheet><Group>", name="sheet.mw") == 3
    assert "the worksheet is not complete XML" in capsys.readouterr().err


def test_a_sheet_of_which_no_input_can_be_read(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Its formulas have an encoding that isn't known; one statement as text makes it readable."""
    formula = '<Text-field><Equation executable="true" style="2D Input" input-equation="">LUk=</Equation></Text-field>'
    text = '<Text-field style="Maple Input">a := 1;</Text-field>'
    sheet = "<Worksheet><Group><Input>{}</Input></Group></Worksheet>"
    assert run(tmp_path, sheet.format(formula), name="sheet.mw") == 3
    found = capsys.readouterr()
    assert "1 statement, 1 failed" in found.out
    assert "no input could be read" in found.err
    assert run(tmp_path, sheet.format(formula + text), name="sheet.mw") == 1
    assert "2 statements, 1 failed" in capsys.readouterr().out


def test_verbose_shows_remarks_and_width_cuts(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(tmp_path, "s := a+b+c+d+e+f; the sum\n", "--verbose", "--width", "10") == 0
    assert capsys.readouterr().out.splitlines()[:2] == ["s := a+...", "Remark, line 1: the sum"]


def test_notices_are_printed_once(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    text = "with(MBSymba_r6):\ngravity_energy(make_BODY(ground, m));\n"
    assert run(tmp_path, text) == 0
    out = capsys.readouterr().out
    assert "Note, line 2: gravity_energy is not a command; did you mean gravitational_energy?" in out


def test_quit_ends_the_sheet(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(tmp_path, "a := 1;\nquit;\nb := 2;\n") == 0
    assert "b := 2" not in capsys.readouterr().out


def test_other_folders_are_allowed_by_an_option(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    other = tmp_path / "other"
    other.mkdir()
    text = f'a := 2*b: save a, "{other.as_posix()}/a.m": a := 3: read "{other.as_posix()}/a.m": a;\n'
    assert run(tmp_path, text, "--any-folder") == 0
    assert capsys.readouterr().out.splitlines()[0] == "2*b"
    assert [file.name for file in other.iterdir()] == ["a.m"]
    assert run(tmp_path, text.replace("a.m", "b.m")) == 0
    assert [file.name for file in other.iterdir()] == ["a.m"]


@pytest.mark.skipif(not hasattr(signal, "SIGINT") or os.name != "posix", reason="signals of POSIX")
def test_ctrl_c_keeps_what_is_done(tmp_path: Path) -> None:
    sheet = tmp_path / "long.mpl"
    sheet.write_text("a := 1;\nfor i to 10^9 do b := i: od:\nc := 2;\n", encoding="utf-8")
    command = [sys.executable, "-u", "-m", "symbody", "run", str(sheet)]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as process:
        assert process.stdout is not None
        assert process.stdout.readline() == "a := 1\n"
        time.sleep(0.5)
        process.send_signal(signal.SIGINT)
        out, err = process.communicate(timeout=60)
    assert process.returncode == 130
    assert "interrupted" in err
    assert out.splitlines()[-1].startswith("1 statement, 0 failed")


def test_notices_about_angles_are_for_writers_of_sheets(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    sheet = "q := evalf(Pi/3): A := rotate('Z',q):\nB := rotate('Z',1.57):\nC := rotate('Z',90.):\n"
    assert run(tmp_path, sheet, name="sheet.mpl") == 0
    notes = [line for line in capsys.readouterr().out.splitlines() if line.startswith("Note")]
    assert [note.partition("; ")[2] for note in notes] == [
        "write Pi/2 if that is meant",
        "angles are in radians: write 90.0*Pi/180 if degrees are meant",
    ]


def test_restart_executes_the_startup_code_again(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    sheet = tmp_path / "sheet.mw"
    field = '<Group><Input><Text-field style="Maple Input">{}</Text-field></Input></Group>'
    groups = "".join(map(field.format, ("b := 2: restart:", "a, b;")))
    sheet.write_text(
        f'<Worksheet><Startup-Code startupcode="a := 7;"/>{groups}</Worksheet>', encoding="utf-8"
    )
    assert main(["run", str(sheet)]) == 0
    assert capsys.readouterr().out.splitlines()[:2] == ["a := 7", "7, b"]
