"""Which output of the file belongs to which output of the run: both in order, some of them without a partner."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import takewhile

from symbody.worksheet.reading.prompts import is_picture
from symbody.worksheet.reading.two_dimensions import is_layout
from symbody.worksheet.sheet import syntax

__all__ = ["Block", "Output", "aligned"]


@dataclass(frozen=True, slots=True)
class Block:
    """An output in the file.

    Attributes:
        text: its text.
        cell: the number of its cell.
        index: its place among the outputs of this cell.
        line: its line if outputs stand between the lines of code, else 0.
    """

    text: str
    cell: int
    index: int
    line: int = 0


@dataclass(frozen=True, slots=True)
class Output:
    """An output of the run.

    Attributes:
        text: its text.
        cell: the number of its cell.
        line: its line.
        number: that of its statement, of which several may come from a loop.
        statement: the statement.
        aliases: what names in it stand for.
    """

    text: str
    cell: int
    line: int
    number: int
    statement: syntax.Statement | None = None
    aliases: tuple[tuple[str, str], ...] = ()


#: The weights of what two outputs have in common; a place directly below a statement outweighs the texts.
_ALIKE, _NEAR, _OTHER_NAME = 2.0, 3.0, 0.25

_HEAD = re.compile(r"\s*(`[^`]*`|\w+(?:\[[^\]]*\])?(?:\(\w+\))?)\s*(:=|=)")


def aligned(blocks: Sequence[Block], outputs: Sequence[Output]) -> list[Output | None]:
    """Return the partner of each block: those with the best sum of likenesses, in the order of both.

    An output may stand several cells below its statement, but not above it. An output directly below a statement
    belongs to it, whatever other statements printed; otherwise a wrong value would pass as that of a neighbour.
    """
    nearest = _nearest(blocks, outputs)
    rows = [[0.0] * (len(outputs) + 1)]
    heads = [_head(output.text) for output in outputs]
    for block, above in zip(blocks, nearest, strict=True):
        before, row = rows[-1], [0.0]
        head = _head(block.text)
        for k, output in enumerate(outputs):
            near = output.line == above and output.cell == block.cell
            likeness = _likeness(block, head, output, heads[k], near=near)
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
    """Return what an output assigns; in two dimensions, the name may stand on any line."""
    lines = text.split("\n") if is_layout(text) else [text]
    match = next(filter(None, map(_HEAD.match, lines)), None)
    return match[1] + match[2] if match else ""


def _nearest(blocks: Sequence[Block], outputs: Sequence[Output]) -> list[int]:
    """Return, for each block, the line of the statement directly above it; 0 if that isn't known.

    It is the last statement above the block, in its cell, that printed something, unless a picture below the block may
    be the output of this statement.
    """
    pictured: set[tuple[int, int]] = set()
    found = []
    for block in reversed(blocks):
        lines = (output.line for output in outputs if output.cell == block.cell)
        line = max((line for line in lines if not block.line or line < block.line), default=0)
        if is_picture(block.text):
            pictured.add((block.cell, line))
        found.append(0 if (block.cell, line) in pictured else line)
    return found[::-1]


def _likeness(block: Block, head: str, output: Output, other: str, *, near: bool) -> float:
    """Return how similar an output and a block are; 0 if they can't be partners.

    Args:
        block: the block.
        head: the name that the block assigns to.
        output: the output.
        other: the name that the output assigns to.
        near: whether the block stands directly below the output's statement.
    """
    if output.cell > block.cell or is_picture(block.text):
        return 0.0
    if head != other:
        return _OTHER_NAME if near else 0.0
    left, right = (re.sub(r"\s", "", _compared(text)[:200]) for text in (block.text, output.text))
    same = sum(1 for _ in takewhile(lambda pair: pair[0] == pair[1], zip(left, right, strict=False)))
    alike = same / max(1, min(len(left), len(right)))
    return (
        (4.0 if head else 1.0)
        + _ALIKE * alike
        + (_NEAR if near else 0.5 if output.cell == block.cell else 0.0)
    )


def _compared(text: str) -> str:
    """Return what is compared of an output: of what Describe prints, the declaration below its words."""
    return text.splitlines()[-1] if text.startswith("# ") else text
