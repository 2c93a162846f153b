"""The command line of ``symbody run``: options, what is printed, progress."""

from __future__ import annotations

import argparse
import sys
import time
from collections.abc import Sequence
from typing import TYPE_CHECKING

from symbody.errors import WorksheetError
from symbody.worksheet.evaluation.session import Session
from symbody.worksheet.interpreter.interpret import Interpreter
from symbody.worksheet.reading import read_source
from symbody.worksheet.run.execution import outcomes
from symbody.worksheet.run.report import INTERRUPTED, NOT_READABLE, Report
from symbody.worksheet.sheet.outcome import Outcome

if TYPE_CHECKING:
    from symbody.worksheet.check import Verdict

__all__ = ["run_file"]

#: Seconds until the progress of a sheet is shown.
_PATIENCE = 2.0


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
        from symbody.worksheet.check import expected_failures, verdicts  # noqa: PLC0415 - for those who ask

        report.failed -= len(expected_failures(cells, done))
        report.verdicts = verdicts(cells, done)
        _show_verdicts(report.verdicts, quiet=options.quiet)
    print(report)
    if report.failed and not any(cell.input for cell in cells):
        print(
            f"symbody run: of {options.file}, no input could be read; the messages tell why", file=sys.stderr
        )
        return NOT_READABLE
    return status or report.status


def _show(outcome: Outcome, options: argparse.Namespace) -> None:
    if outcome.remark is not None and options.verbose:
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
