"""The statements of a sheet, executed one by one."""

from __future__ import annotations

import warnings
from collections.abc import Iterator, Sequence
from contextlib import suppress

from symbody.errors import WorksheetError
from symbody.worksheet.evaluation.notices import in_maple_words
from symbody.worksheet.interpreter.interpret import Interpreter, Stop
from symbody.worksheet.printing.print import text_of
from symbody.worksheet.reading import located, names_in_code, statements
from symbody.worksheet.sheet.outcome import Outcome
from symbody.worksheet.sheet.source import Cell, Remark, SyntaxMistake
from symbody.worksheet.sheet.syntax import Evaluation, Name, Place, Statement

__all__ = ["outcomes"]


def outcomes(cells: Sequence[Cell], interpreter: Interpreter) -> Iterator[Outcome]:
    """Execute the statements of a sheet one by one; an error ends its statement only."""
    used = names_in_code(cells)
    for number, cell in enumerate(cells):
        for item in statements(cell, used):
            if isinstance(item, Remark):
                notices = (item.notice,) if item.notice else ()
                yield Outcome(number, item.place.line, notices=notices, remark=item.text)
            elif isinstance(item, SyntaxMistake):
                yield Outcome(number, item.place.line, error=item.message)
            else:
                try:
                    yield _executed(number, cell, item, interpreter)
                    if _restarts(item):
                        _start(cells, interpreter)
                except Stop:
                    return


def _restarts(statement: Statement) -> bool:
    match statement:
        case Evaluation(expression=Name(name="restart")):
            return True
    return False


def _start(cells: Sequence[Cell], interpreter: Interpreter) -> None:
    """Execute the startup code of a file again; its mistakes were told when the file was opened."""
    for cell in cells:
        for item in statements(cell) if cell.is_startup else ():
            if isinstance(item, Statement):
                with suppress(WorksheetError):
                    interpreter.execute(item)
    interpreter.session.lines.clear()


def _executed(number: int, cell: Cell, statement: Statement, interpreter: Interpreter) -> Outcome:
    session, error = interpreter.session, ""
    session.notices.clear()
    with warnings.catch_warnings(record=True) as raised:
        warnings.simplefilter("always")
        try:
            interpreter.execute(statement)
        except Stop:
            raise
        except WorksheetError as reason:
            place = reason.place if isinstance(reason.place, Place) else statement.place
            error = located(cell, place, str(reason))
            session.keep_exception(str(reason))
        except Exception as fault:
            text = (
                f"a fault of symbody, {type(fault).__name__}: {str(fault)[:200]}; please report the statement"
            )
            error = located(cell, statement.place, text)
    told = map(in_maple_words, [*session.notices, *(str(warning.message) for warning in raised)])
    notices = tuple(dict.fromkeys(notice for notice in told if notice))
    aliases = tuple((name, text_of(value)) for name, value in session.options.aliases.items())
    printed = tuple(session.lines)
    return Outcome(number, statement.place.line, statement, printed, error, notices, aliases=aliases)
