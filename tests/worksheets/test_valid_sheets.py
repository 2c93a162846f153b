"""Every valid worksheet runs without a mistake, prints what it says, and all commands are in one of them."""

from __future__ import annotations

import argparse
import re
from pathlib import Path

import pytest

from symbody.__main__ import add_run_options
from symbody.worksheet import builtins
from symbody.worksheet.commands.mbsymba import COMMANDS, describe
from symbody.worksheet.run import run_file

SHEETS = sorted(path for path in (Path(__file__).parent / "valid").iterdir() if path.is_file())
"""The worksheets; what a run by hand has written beside them is in folders."""
FORBIDDEN = {"system", "ssystem"}
"""Commands that only say that a worksheet can't run programs; an invalid sheet uses them."""
SECOND = {"car_steady.mpl"}
"""Sheets that read what another one has saved; their own tests run them."""


@pytest.mark.parametrize("path", SHEETS, ids=lambda path: path.name)
def test_sheets_run_and_print_what_they_say(
    path: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    if path.name in SECOND:
        return
    parser = argparse.ArgumentParser()
    add_run_options(parser)
    status = run_file(parser.parse_args([str(path), "--check", "--quiet", "--out", str(tmp_path)]))
    printed = capsys.readouterr().out
    assert status == 0, printed
    assert ", 0 failed, " in printed.splitlines()[-1]


def test_every_command_is_in_a_sheet() -> None:
    text = "\n".join(path.read_text(encoding="utf-8") for path in SHEETS)
    used = {*re.findall(r"\w+|&\w+", text), *re.findall(r" (\$) ", text), *re.findall(r"`(\W+)`\(", text)}
    families = [*builtins.PACKAGES.values(), builtins.KERNEL, builtins.FORMS, COMMANDS]
    assert sorted({name for family in families for name in family} - used - FORBIDDEN) == []


@pytest.mark.parametrize("name", sorted(COMMANDS))
def test_commands_of_mbsymba_are_described(name: str) -> None:
    text = describe(name)
    assert text is not None
    assert re.match(r"(# .+\n)+\w+\(", text), text
