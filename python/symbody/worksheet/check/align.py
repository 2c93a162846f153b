"""Which output of the file belongs to which output of the run: both in order, some of them without a partner."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import takewhile

from symbody.worksheet.sheet import syntax

__all__ = ["Block", "Output", "aligned"]


@dataclass(frozen=True, slots=True)
class Block:
    """An output in the file: its text, the number of its cell, and its place among the outputs of this cell."""

    text: str
    cell: int
    index: int


@dataclass(frozen=True, slots=True)
class Output:
    """An output of the run: its text, its cell, its line, and its statement, of which several may come from a loop."""

    text: str
    cell: int
    line: int
    number: int
    statement: syntax.Statement | None = None


_HEAD = re.compile(r"\s*(`[^`]*`|\w+(?:\[[^\]]*\])?(?:\(\w+\))?)\s*(:=|=)")


def aligned(blocks: Sequence[Block], outputs: Sequence[Output]) -> list[Output | None]:
    """Return the partner of each block: those with the best sum of likenesses, in the order of both.

    Outputs can stand cells further down than their statement, but not before it.
    """
    rows = [[0.0] * (len(outputs) + 1)]
    heads = [_head(output.text) for output in outputs]
    for block in blocks:
        before, row = rows[-1], [0.0]
        head = _head(block.text)
        for k, output in enumerate(outputs):
            likeness = _likeness(block, head, output, heads[k])
            row.append(max(before[k + 1], row[k], before[k] + likeness if likeness else 0.0))
        rows.append(row)
    partners: list[Output | None] = [None] * len(blocks)
    i, k = len(blocks), len(outputs)
    while i and k:
        if rows[i][k] == rows[i - 1][k]:
            i -= 1
        elif rows[i][k] == rows[i][k - 1]:
            k -= 1
        else:
            i, k = i - 1, k - 1
            partners[i] = outputs[k]
    return partners


def _head(text: str) -> str:
    match = _HEAD.match(text)
    return match[1] + match[2] if match else ""


def _likeness(block: Block, head: str, output: Output, other: str) -> float:
    """Return how much an output looks like a block, 0 if it can't be its partner."""
    if output.cell > block.cell or head != other:
        return 0.0
    left, right = (re.sub(r"\s", "", _compared(text)[:200]) for text in (block.text, output.text))
    same = sum(1 for _ in takewhile(lambda pair: pair[0] == pair[1], zip(left, right, strict=False)))
    alike = same / max(1, min(len(left), len(right)))
    return (4.0 if head else 1.0) + 2.0 * alike + (0.5 if output.cell == block.cell else 0.0)


def _compared(text: str) -> str:
    """Return what is compared of an output: of what Describe prints, the declaration below its words."""
    return text.splitlines()[-1] if text.startswith("# ") else text
