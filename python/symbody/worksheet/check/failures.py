"""Statements that fail in the file too: it shows Maple's ``Error, ..`` below them."""

from __future__ import annotations

import re
from collections.abc import Sequence

from symbody.worksheet.sheet.outcome import Outcome
from symbody.worksheet.sheet.source import Cell

__all__ = ["expected_failures"]

_ERROR = re.compile(r"\s*Error,")


def expected_failures(cells: Sequence[Cell], outcomes: Sequence[Outcome]) -> tuple[Outcome, ...]:
    """Return the statements that failed and of which the file shows an error, whatever its words.

    The failures of a cell are those of the file where there are as many; where there are not, none of them counts as
    expected, because which statement an error belongs to is not known.
    """
    found: list[Outcome] = []
    for number, cell in enumerate(cells):
        errors = sum(_ERROR.match(text) is not None for text in cell.printed)
        failed = [each for each in outcomes if each.cell == number and each.error]
        if errors == len(failed):
            found += failed
    return tuple(found)
