"""Lines of prose that begin with a word and its number: ``rod 1``, ``link 2: the coupler``, ``1st part``."""

from __future__ import annotations

from collections.abc import Collection, Sequence

from lark import Token

from symbody.worksheet.reading.parse import TERMINATORS, is_statement
from symbody.worksheet.reading.prose import LITERALS, MARKS, WORDS

__all__ = ["is_numbered"]

_KINDS = WORDS | LITERALS | MARKS - {"SEMICOLON"} | {"QUOTE", "LPAR", "RPAR"}
_ORDINALS = frozenset({"st", "nd", "rd", "th"})


def is_numbered(line: Sequence[Token], used: Collection[str]) -> bool:
    """Whether a line without a terminator is prose with a number at its beginning; its noun is no name of the code."""
    if len(line) < 2 or line[-1].type in TERMINATORS or any(token.type not in _KINDS for token in line):
        return False
    colon = next((k + 1 for k, token in enumerate(line) if token.type == "COLON"), len(line))
    return _has_numbered_noun(line, used) and not is_statement(line[colon:])


def _has_numbered_noun(line: Sequence[Token], used: Collection[str]) -> bool:
    first, second = line[:2]
    if first.type == "NAME":
        return second.type in LITERALS and first not in used
    if first.type not in LITERALS or second.type != "NAME":
        return False
    is_glued = first.end_column == second.column
    if is_glued or second in used:  # 2 x y is a product in two dimensions
        return is_glued and second in _ORDINALS
    return len(line) > 2 and line[2].type in WORDS
