"""Formulas that are printed in two dimensions: a bar, or lines that are all indented."""

from __future__ import annotations

import re

__all__ = ["has_bar", "is_indented", "is_layout"]

_LAYOUT = re.compile(r"\s{8,}\S")
_BAR = re.compile(r"-{4,}")


def is_layout(block: str) -> bool:
    """Whether a block is a formula in two dimensions: lines of which one has a bar, or all are indented."""
    lines = block.split("\n")
    return len(lines) > 1 and (any(map(has_bar, lines)) or all(map(is_indented, lines)))


def has_bar(line: str) -> bool:
    """Whether a line has the bar of a fraction."""
    return _BAR.search(line) is not None


def is_indented(line: str) -> bool:
    """Whether a line begins far to the right, as printed formulas do."""
    return _LAYOUT.match(line) is not None
