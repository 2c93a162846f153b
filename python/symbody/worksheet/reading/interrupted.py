"""Loops and procedures that an export interrupts: with prompts before their statements, and with prose between them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from symbody.worksheet.reading.parse import Failure, next_statement, opened, tokens_of
from symbody.worksheet.reading.prompts import is_message, is_picture, prompt_of
from symbody.worksheet.reading.statements import statements
from symbody.worksheet.sheet.source import Cell, Line, SyntaxMistake

__all__ = ["begins_block", "with_whole_blocks"]

#: How many lines a loop or a procedure can have.
_LONGEST = 400

_HEADS = frozenset({"FOR", "CLAUSE", "IF", "TRY"})
_OPENING = frozenset({"DO", "THEN"})
_ENDING = frozenset({"END", "OD", "FI", "DO", "IF", "PROC", "TRY", "SEMICOLON", "COLON"})


def with_whole_blocks(paragraphs: Sequence[list[Line]]) -> Iterator[list[Line]]:
    """Return paragraphs, those joined to one over which a loop or a procedure goes.

    Nothing is printed before a loop ends. So what stands between its statements is a remark, if all of it can be read
    up to its end; else it was no loop, and nothing is joined.
    """
    index = 0
    while index < len(paragraphs):
        end = _end_of_block(paragraphs, index)
        yield [line for paragraph in paragraphs[index:end] for line in paragraph]
        index = end


def begins_block(line: Line) -> bool:
    """Whether a line is the head of a loop or a condition: ``for k from 1 to 3 do``."""
    tokens = tokens_of(line)
    if not tokens or tokens[0].type not in _HEADS or tokens[-1].type not in _OPENING:
        return False
    found = next_statement(tokens)
    return isinstance(found, Failure) and found.index == len(tokens)


def _end_of_block(paragraphs: Sequence[list[Line]], begin: int) -> int:
    """Return the index behind the paragraph in which all blocks end that are open at the end of one."""
    depth = _depth(paragraphs[begin], 0)
    if not depth:
        return begin + 1
    lines = list(paragraphs[begin])
    for index in range(begin + 1, len(paragraphs)):
        lines += paragraphs[index]
        if len(lines) > _LONGEST or any(_is_printed(line) for line in paragraphs[index]):
            break
        depth = _depth(paragraphs[index], depth)
        if not depth:
            return index + 1 if _can_be_read(lines) else begin + 1
    return begin + 1


def _depth(lines: Sequence[Line], depth: int) -> int:
    """Return how many blocks are open behind some lines."""
    for line in lines:
        tokens = tokens_of(_code(line))
        kinds = {token.type for token in tokens}
        if prompt_of(line) or kinds <= _ENDING or begins_block(line):
            depth = max(0, depth + sum(opened(tokens, index) for index in range(len(tokens))))
    return depth


def _code(line: Line) -> Line:
    begin = prompt_of(line)
    return Line(line.text[begin:], line.line, line.column + begin)


def _is_printed(line: Line) -> bool:
    return is_message(line.text) or is_picture(line.text) or line.text.rstrip().endswith("...")


def _can_be_read(lines: Sequence[Line]) -> bool:
    """Whether the code from the first prompt or head on has no mistakes."""
    first = next(k for k, line in enumerate(lines) if prompt_of(line) or begins_block(line))
    cell = Cell(tuple(_code(line) for line in lines[first:]))
    return not any(isinstance(one, SyntaxMistake) for one in statements(cell))
