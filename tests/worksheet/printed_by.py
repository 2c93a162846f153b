"""What statements print: the tests of the interpreter drive it by text."""

from __future__ import annotations

from pathlib import Path

from symbody.errors import WorksheetError
from symbody.worksheet.interpreter.interpret import Interpreter
from symbody.worksheet.reading.files import source_cells
from symbody.worksheet.reading.statements import statements
from symbody.worksheet.sheet.source import Remark, SyntaxMistake

__all__ = ["failures", "printed"]


def run(text: str, folder: Path | None, interpreter: Interpreter | None) -> tuple[list[str], list[str]]:
    interpreter = interpreter or Interpreter()
    if folder is not None:
        interpreter.session.folder = folder
    lines: list[str] = []
    errors: list[str] = []
    for cell in source_cells(text):
        for statement in statements(cell):
            assert not isinstance(statement, SyntaxMistake), statement
            if isinstance(statement, Remark):
                continue
            try:
                lines += interpreter.execute(statement)
            except WorksheetError as error:
                errors.append(str(error))
    return lines, errors


def printed(text: str, folder: Path | None = None, interpreter: Interpreter | None = None) -> list[str]:
    """Return the lines that statements print; none of them fails."""
    lines, errors = run(text, folder, interpreter)
    assert not errors, errors
    return lines


def failures(text: str, folder: Path | None = None, interpreter: Interpreter | None = None) -> list[str]:
    """Return the messages of the statements that fail."""
    return run(text, folder, interpreter)[1]
