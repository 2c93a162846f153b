"""Statements of other files than the worksheet, which ``read`` executes: where their errors are."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

from symbody.errors import WorksheetError
from symbody.worksheet.evaluation.session import Session
from symbody.worksheet.reading import located
from symbody.worksheet.sheet.source import ReadFile
from symbody.worksheet.sheet.syntax import Place

__all__ = ["in_file"]


@contextmanager
def in_file(session: Session, file: ReadFile | None, place: Place | None = None) -> Iterator[None]:
    """Execute what is written in a file, or in the worksheet (None), perhaps for a statement of another one.

    An error that leaves the file says in its message where it is; its place is that of the statement outside.
    ``place`` is for errors that don't know theirs.
    """
    before, session.file = session.file, file
    try:
        yield
    except WorksheetError as error:
        found = error.place if isinstance(error.place, Place) else place
        if file is before or found is None:
            raise
        raise WorksheetError(_told(file, found, str(error))) from error
    finally:
        session.file = before


def _told(file: ReadFile | None, place: Place, message: str) -> str:
    """Return a message with its place in a file, and below it the line with a caret."""
    if file is None:
        return f"{message} (line {place.line} of the worksheet)"
    cells = [cell for cell in file.cells if any(line.line == place.line for line in cell.input)]
    return f'in "{file.name}", {located((cells or file.cells)[0], place, message)}'
