"""The names that occur in the code of a cell."""

from __future__ import annotations

from collections.abc import Sequence

from lark import Token

from symbody.worksheet.reading.loose_text import loose_part
from symbody.worksheet.reading.prose import is_used

__all__ = ["used_names"]


def used_names(lines: Sequence[Sequence[Token]]) -> frozenset[str]:
    """Return the names that occur in the code of a cell: beside an operator or a bracket."""
    found: set[str] = set()
    for before, line, following in zip([(), *lines], lines, [*lines[1:], ()], strict=False):
        begin = loose_part(before, line, following)
        found |= {str(line[i]) for i in range(len(line) if begin is None else begin) if is_used(line, i)}
    return frozenset(found)
