"""Text behind the last terminator of a line with a prompt, before a line with another prompt: ``a := 5; mass [kg]``."""

from __future__ import annotations

from collections.abc import Collection, Sequence

from lark import Token

from symbody.worksheet.reading.parse import TERMINATORS, Failure, Parsed, is_statement, next_statement

__all__ = ["end_before_prompt"]

_OPENING = frozenset({"LPAR", "LSQB", "LBRACE"})
_GOES_ON = frozenset({"COMMA", "PLUS", "MINUS", "TIMES", "OVER", "POWER", "EQUAL"}) | _OPENING


def end_before_prompt(
    tokens: Sequence[Token], begin: int, found: Parsed | Failure, prompted: Collection[int]
) -> int | None:
    """Return where a text ends that the line behind the next prompt doesn't complete; None if there is none.

    A bracket behind a prompt is no index of such a text, and closes none of its brackets.
    """
    line = tokens[begin].line
    if not begin or tokens[begin - 1].line != line or tokens[begin - 1].type not in TERMINATORS:
        return None
    end = next((k for k in range(begin, len(tokens)) if tokens[k].line != line), len(tokens))
    text = tokens[begin:end]
    if end == len(tokens) or tokens[end].line not in prompted or not tokens[end]:
        return None
    if any(token.type in TERMINATORS or token == ":=" for token in text):
        return None
    if isinstance(found, Parsed):
        return end if tokens[end].type in _OPENING and is_statement(text) else None
    is_unclosed = sum(_depth(token) for token in text) > 0 and text[-1].type not in _GOES_ON
    is_text = found.index >= end if is_statement(text) else is_unclosed
    return end if is_text and _stands_alone(tokens, end) else None


def _stands_alone(tokens: Sequence[Token], begin: int) -> bool:
    """Whether a statement begins here, or a mistake that has nothing to do with the line before."""
    found = next_statement(tokens, begin)
    return isinstance(found, Parsed) or found.index > begin


def _depth(token: Token) -> int:
    return (token.type in _OPENING) - (token.type in {"RPAR", "RSQB", "RBRACE"})
