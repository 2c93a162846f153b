"""The command line of ``symbody convert``."""

from __future__ import annotations

import argparse
import sys

from symbody.errors import SymbodyError, WorksheetError
from symbody.files.replacement import write_texts
from symbody.worksheet.convert.program import converted
from symbody.worksheet.evaluation.session import Session
from symbody.worksheet.reading import read_source

__all__ = ["convert_file"]


def convert_file(options: argparse.Namespace) -> int:
    """Write the program of a worksheet, and return the exit status."""
    try:
        cells = read_source(options.file)
    except (OSError, WorksheetError) as error:
        print(f"symbody convert: {options.file} is not readable: {error}", file=sys.stderr)
        return 3
    session = Session(folder=options.program.parent, source=options.file.parent)
    made = converted(cells, options.file.stem, session)
    try:
        write_texts(options.program.parent, {options.program.name: made.text})
    except (OSError, SymbodyError) as error:
        print(f"symbody convert: {options.program} can't be written: {error}", file=sys.stderr)
        return 3
    failed = f", {made.failed} failed" if made.failed else ""
    print(
        f"{made.code} statements written as code, {made.values} as values, {made.left_out} left out{failed}"
    )
    return int(made.failed > 0)
