"""Remarks between ``(*`` and ``*)``, which may go over several lines."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import replace
from itertools import accumulate

from symbody.worksheet.sheet.source import Line

__all__ = ["without_block_remarks"]

_PIECE = re.compile(
    r"""(?P<block>\(\*.*?\*\))|"(?:[^"\\\n]|\\.)*"|`[^`\n]*`|\#[^\n]*""",
    re.DOTALL,
)
"""A remark that is closed; or what is read before one is looked for: strings, names, remarks to the end of the line."""


def without_block_remarks(lines: Iterable[Line]) -> list[Line]:
    """Return lines with blanks in the place of remarks between ``(*`` and ``*)``; columns stay."""
    given = list(lines)
    whole = "".join(line.text for line in given)
    if "(*" not in whole:
        return given
    blanked = _PIECE.sub(lambda found: _blanks(found[0]) if found["block"] else found[0], whole)
    ends = [0, *accumulate(len(line.text) for line in given)]
    return [replace(line, text=blanked[a:b]) for line, a, b in zip(given, ends, ends[1:], strict=False)]


def _blanks(text: str) -> str:
    return re.sub(r"[^\n]", " ", text)
