"""``symbody run``: a worksheet from its file to what Maple would print."""

from __future__ import annotations

import argparse
import sys
import time
import warnings
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from symbody.errors import WorksheetError
from symbody.worksheet.interpret import Interpreter, Stop
from symbody.worksheet.outcome import Outcome
from symbody.worksheet.reading import located, names_in_code, read_source, statements
from symbody.worksheet.session import Session
from symbody.worksheet.source import Cell, Remark, SyntaxMistake
from symbody.worksheet.syntax import Place, Statement

if TYPE_CHECKING:
    from symbody.worksheet.check import Verdict

__all__ = ["Report", "outcomes", "run_file"]

#: Exit statuses.
FAILED, DIFFERENT, NOT_READABLE, INTERRUPTED = 1, 2, 3, 130

#: Seconds until the progress of a sheet is shown.
_PATIENCE = 2.0


@dataclass(slots=True)
class Report:
    """What became of a sheet's statements."""

    statements: int = 0
    failed: int = 0
    verdicts: list[Verdict] = field(default_factory=list)

    def count(self, *kinds: str) -> int:
        """Return how many comparisons came out in one of these ways."""
        return sum(verdict.kind in kinds for verdict in self.verdicts)

    def __str__(self) -> str:
        noun = "statement" if self.statements == 1 else "statements"
        return (
            f"{self.statements} {noun}, {self.failed} failed, {self.count('equal', 'differs')} compared, "
            f"{self.count('differs')} different, {self.count('not comparable')} not comparable"
        )

    @property
    def status(self) -> int:
        """The exit status."""
        return FAILED if self.failed else DIFFERENT if self.count("differs") else 0


def outcomes(cells: Sequence[Cell], interpreter: Interpreter) -> Iterator[Outcome]:
    """Execute the statements of a sheet one by one; an error ends its statement only."""
    used = names_in_code(cells)
    for number, cell in enumerate(cells):
        for item in statements(cell, used):
            if isinstance(item, Remark):
                yield Outcome(number, item.place.line, remark=item.text)
            elif isinstance(item, SyntaxMistake):
                yield Outcome(number, item.place.line, error=item.message)
            else:
                try:
                    yield _executed(number, cell, item, interpreter)
                except Stop:
                    return


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
        except Exception as fault:
            text = (
                f"a fault of symbody, {type(fault).__name__}: {str(fault)[:200]}; please report the statement"
            )
            error = located(cell, statement.place, text)
    notices = [*session.notices, *(str(warning.message) for warning in raised)]
    lines = tuple(session.lines)
    return Outcome(number, statement.place.line, statement, lines, error, tuple(dict.fromkeys(notices)))


def run_file(options: argparse.Namespace) -> int:
    """Run a worksheet as the options say, print what it prints, and return the exit status."""
    try:
        cells = read_source(options.file)
    except (OSError, WorksheetError) as error:
        print(f"symbody run: {options.file} is not readable: {error}", file=sys.stderr)
        return NOT_READABLE
    folder = options.out or options.file.with_name(f"{options.file.stem}_out")
    session = Session(folder=folder, source=options.file.parent, any_folder=options.any_folder)
    report, done, status = Report(), [], 0
    progress = _Progress(sum(len(cell.input) for cell in cells))
    try:
        for outcome in outcomes(cells, Interpreter(session)):
            done.append(outcome)
            report.statements += outcome.remark is None
            report.failed += bool(outcome.error)
            progress.clear()
            _show(outcome, options)
            progress.show(outcome.line)
    except KeyboardInterrupt:
        print("\ninterrupted: what was printed and written so far is kept", file=sys.stderr)
        status = INTERRUPTED
    progress.clear()
    if options.check:
        from symbody.worksheet.check import verdicts  # noqa: PLC0415 - a second reader, for those who ask

        report.verdicts = verdicts(cells, done)
        _show_verdicts(report.verdicts, quiet=options.quiet)
    print(report)
    return status or report.status


def _show(outcome: Outcome, options: argparse.Namespace) -> None:
    if outcome.remark is not None:
        if options.verbose:
            print(f"Remark, line {outcome.line}: {outcome.remark}")
        return
    if not options.quiet:
        for text in outcome.printed:
            print("\n".join(_cut(line, options.width) for line in text.split("\n")))
        for notice in outcome.notices:
            print(f"Note, line {outcome.line}: {notice}")
    if outcome.error:
        print(f"Error, {outcome.error}")


def _cut(line: str, width: int | None) -> str:
    return line if width is None or len(line) <= width else line[: max(0, width - 3)] + "..."


def _show_verdicts(found: Sequence[Verdict], *, quiet: bool) -> None:
    for verdict in found:
        if not quiet or verdict.kind == "differs":
            print(f"Check, line {verdict.line}: {verdict}")


class _Progress:
    """On a terminal, the line that a long sheet has come to."""

    def __init__(self, lines: int) -> None:
        self.lines, self.begin, self.shown = lines, time.monotonic(), False

    def show(self, line: int) -> None:
        if sys.stderr.isatty() and time.monotonic() - self.begin > _PATIENCE:
            print(f"\rline {line}, {self.lines} lines of code", end="", file=sys.stderr, flush=True)
            self.shown = True

    def clear(self) -> None:
        if self.shown:
            print("\r\033[K", end="", file=sys.stderr, flush=True)
            self.shown = False
