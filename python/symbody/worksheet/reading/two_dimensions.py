"""Formulas that are printed in two dimensions: a bar, or lines that are all indented."""

from __future__ import annotations

import re
from itertools import pairwise

from symbody.worksheet.reading.parse import Parsed, next_statement, terminator_after, tokens_of
from symbody.worksheet.sheet.source import Line

__all__ = ["has_bar", "is_indented", "is_layout"]

_LAYOUT = re.compile(r"\s{8,}\S")
_GAP_OF_ROWS = re.compile(r"(?:.*:=)?\s*\[\s+\]\s*$")
_BAR = re.compile(r"-{4,}")


def is_layout(block: str) -> bool:
    """Whether a block is a formula in two dimensions: one line has a bar or is a gap between rows, or all are indented.

    Outputs below each other are none: each line is a value, and all are centred, or begin in one column.
    """
    lines = block.split("\n")
    return len(lines) > 1 and (
        any(map(has_bar, lines))
        or any(map(_GAP_OF_ROWS.match, lines))
        or (all(map(is_indented, lines)) and not _are_outputs(lines))
    )


def _are_outputs(lines: list[str]) -> bool:
    """Whether indented lines are one output each."""
    begins = [len(line) - len(line.lstrip()) for line in lines]
    centres = [begin + len(line.strip()) / 2 for begin, line in zip(begins, lines, strict=True)]
    is_column = len(set(begins)) == 1 or max(centres) - min(centres) <= 1
    return is_column and all(map(_is_value, lines)) and not any(_has_gaps(*pair) for pair in pairwise(lines))


def _is_value(line: str) -> bool:
    tokens = tokens_of(Line(line, 1))
    if not tokens:
        return False
    found = next_statement([*tokens, terminator_after(tokens[-1])])
    return isinstance(found, Parsed) and found.end > len(tokens)


def _has_gaps(one: str, two: str) -> bool:
    """Whether a line has gaps where the other one has its signs: exponents above, indices below."""
    return _stands_in_gaps(one, two) or _stands_in_gaps(two, one)


def _stands_in_gaps(small: str, large: str) -> bool:
    return all(
        not large[found.start() : found.end() + 1].strip() and large[: found.start()].strip()
        for found in re.finditer(r"\S+", small)
    )


def has_bar(line: str) -> bool:
    """Whether a line has the bar of a fraction."""
    return _BAR.search(line) is not None


def is_indented(line: str) -> bool:
    """Whether a line begins far to the right, as printed formulas do."""
    return _LAYOUT.match(line) is not None
