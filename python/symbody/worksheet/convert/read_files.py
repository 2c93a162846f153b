"""Files with procedures that a worksheet reads: their statements stand in the program in the place of ``read``."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import TypeAlias

from symbody.errors import WorksheetError
from symbody.worksheet.builtins.files import file_to_read
from symbody.worksheet.evaluation.session import Session
from symbody.worksheet.reading import names_in_code, statements
from symbody.worksheet.reading.files import source_cells
from symbody.worksheet.sheet import syntax
from symbody.worksheet.sheet.source import Cell, Remark, SyntaxMistake
from symbody.worksheet.sheet.within import mentions, nodes_in
from symbody.worksheet.values.value import String

__all__ = ["Item", "items_of", "with_read_cells"]

Item: TypeAlias = syntax.Statement | Remark | SyntaxMistake


@dataclass(frozen=True, slots=True)
class Library:
    """A file with procedures.

    Attributes:
        name: its name.
        cells: what is in it.
        items: its statements and remarks.
    """

    name: str
    cells: tuple[Cell, ...]
    items: tuple[Item, ...]


def items_of(
    cells: Sequence[Cell], session: Session
) -> Iterator[tuple[tuple[Cell, ...], Cell, Item | None, str]]:
    """Return the statements of a sheet and of the files that it reads.

    Each has the cells of its file, its cell, and the name of the file, which is "" for the sheet. None stands before
    the first statement of each cell of the sheet.
    """
    used = names_in_code(cells)
    found = [(cell, tuple(statements(cell, used))) for cell in cells]
    written = _written_files(item for _, items in found for item in items)
    for cell, items in found:
        yield (*cells,), cell, None, ""
        for item in items:
            library = _library(item, session, written)
            if library is None or not isinstance(item, syntax.Read):
                yield (*cells,), cell, item, ""
                continue
            for each in library.items:
                silent = not item.shown and not isinstance(each, Remark | SyntaxMistake)
                yield (
                    library.cells,
                    library.cells[0],
                    replace(each, shown=False) if silent else each,  # type: ignore[arg-type]
                    library.name,
                )


def with_read_cells(cells: Sequence[Cell], session: Session) -> tuple[Cell, ...]:
    """Return the cells of a sheet and of the files with procedures that it reads."""
    more = {id(each): each for one, _, _, name in items_of(cells, session) if name for each in one}
    return (*cells, *more.values())


def _library(item: Item, session: Session, written: frozenset[str]) -> Library | None:
    """Return the file that a statement reads, if it is there already, can be read, and has procedures."""
    name = _name_of(item.file) if isinstance(item, syntax.Read) else ""
    if not name or name in written:
        return None
    try:
        name, text = file_to_read(session, String(name))
        cells = source_cells(text)
    except (OSError, WorksheetError):
        return None
    used = names_in_code(cells)
    items = tuple(each for cell in cells for each in statements(cell, used))
    has_procedures = any(mentions(each, syntax.Procedure) for each in items)
    whole = not any(isinstance(each, SyntaxMistake | syntax.Read | syntax.Quit) for each in items)
    return Library(name, cells, items) if has_procedures and whole else None


def _written_files(items: Iterator[Item]) -> frozenset[str]:
    """Return the names of files that the sheet itself writes."""
    saved = (node for item in items for node in nodes_in(item) if isinstance(node, syntax.Save))
    return frozenset(_name_of(each.arguments[-1]) for each in saved)


def _name_of(file: syntax.Expression) -> str:
    """Return the name of a file that is written as such; "" for one that is computed."""
    match file:
        case syntax.Text(text=text):
            return text
        case syntax.Name(name=name):
            return name
    return ""
