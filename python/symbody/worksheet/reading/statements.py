"""Cells to statements: each with its place, and what can't be read as a mistake that doesn't stop the others."""

from __future__ import annotations

from collections.abc import Iterator

from lark import Token

from symbody.worksheet.reading.mistake import mistake
from symbody.worksheet.reading.parse import (
    TERMINATORS,
    Failure,
    next_statement,
    terminator_after,
    tokens_of,
)
from symbody.worksheet.source import Cell, Remark, SyntaxMistake
from symbody.worksheet.syntax import Statement

__all__ = ["statements"]


def statements(cell: Cell) -> Iterator[Statement | Remark | SyntaxMistake]:
    """Return the statements of a cell in order, with mistakes and remarks where they stand.

    The end of the cell ends a statement. Behind a mistake, reading goes on with the next statement.
    """
    tokens = [token for line in cell.input for token in tokens_of(line)]
    if tokens and tokens[-1].type not in TERMINATORS:
        tokens.append(terminator_after(tokens[-1]))
    begin = 0
    while begin < len(tokens):
        found = next_statement(tokens, begin)
        if isinstance(found, Failure):
            yield mistake(cell, tokens, found)
            begin = _next_begin(tokens, found.index)
        else:
            yield found.statement
            begin = found.end


def _next_begin(tokens: list[Token], index: int) -> int:
    """Return where the next statement begins: behind the next terminator."""
    for behind in range(index, len(tokens)):
        if tokens[behind].type in TERMINATORS:
            return behind + 1
    return len(tokens)
