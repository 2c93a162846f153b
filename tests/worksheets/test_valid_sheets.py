"""Every valid worksheet runs without a mistake, prints what it says, and all commands are in one of them."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from symbody.worksheet import builtins
from symbody.worksheet.mbsymba import COMMANDS, describe

VALID = Path(__file__).parent / "valid"
FORBIDDEN = {"system", "ssystem"}
"""Commands that only say that a worksheet can't run programs; an invalid sheet uses them."""
SECOND = {"car_steady.mpl"}
"""Sheets that read what another one has saved; their own tests run them."""


@pytest.mark.parametrize("path", sorted(VALID.iterdir()), ids=lambda path: path.name)
def test_sheets_run_and_print_what_they_say(path: Path, tmp_path: Path) -> None:
    if path.name in SECOND:
        return
    command = [
        sys.executable,
        "-m",
        "symbody",
        "run",
        "--check",
        "--quiet",
        "--out",
        str(tmp_path),
        str(path),
    ]
    done = subprocess.run(command, capture_output=True, text=True, timeout=120, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    assert ", 0 failed, " in done.stdout.splitlines()[-1]


def test_every_command_is_in_a_sheet() -> None:
    text = "\n".join(path.read_text(encoding="utf-8") for path in VALID.iterdir())
    used = {*re.findall(r"\w+", text), *re.findall(r" (\$) ", text)}
    families = [*builtins.PACKAGES.values(), builtins.KERNEL, builtins.FORMS, COMMANDS]
    assert sorted({name for family in families for name in family} - used - FORBIDDEN) == []


@pytest.mark.parametrize("name", sorted(COMMANDS))
def test_commands_of_mbsymba_are_described(name: str) -> None:
    text = describe(name)
    assert text is not None
    assert re.match(r"# .+\n\w+\(", text), text
