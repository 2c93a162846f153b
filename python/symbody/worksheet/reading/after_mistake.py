"""Where reading resumes after a mistake: after its terminator, or earlier, where the next statement begins.

A statement with a bracket, quote or string that is never closed has no terminator of its own: the terminator of the
next statement doesn't end it.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence

from lark import Token

from symbody.worksheet.reading.parse import TERMINATORS, Parsed, is_statement, next_statement, opened
from symbody.worksheet.reading.prose import CLOSING, OPENING

__all__ = ["next_begin"]

#: Words that begin a statement and never occur in an expression.
_STATEMENTS = frozenset({"FOR", "TRY", "READ", "SAVE", "DECLARED"})
_OF_TARGETS = OPENING | CLOSING | {"NAME", "BACKQUOTED", "COMMA", "INTEGER", "STRING", "QUOTE"}
_STRING_MARKS = frozenset({'"', "`"})

#: Signs that continue the line before: after a prompt, a line that begins with one is not a statement.
_SIGNS = frozenset({"PLUS", "MINUS", "SEMICOLON", "COLON"})

#: How many tokens are read to find out whether a statement begins after a prompt.
_LONGEST = 200


def next_begin(tokens: Sequence[Token], begin: int, index: int, prompted: Collection[int]) -> int:
    """Return where the next statement after a mistake begins, outside of all loops and procedures.

    A command of the system, ``!ls``, and an unclosed string end with their line.

    Args:
        tokens: those of the cell.
        begin: where the statement with the mistake begins.
        index: the index of the unexpected token.
        prompted: the numbers of the lines after a prompt.
    """
    depth, ending = 0, _ending_line(tokens, begin, index)
    for place in range(begin, len(tokens)):
        is_first = place > begin and tokens[place].line != tokens[place - 1].line and bool(tokens[place])
        is_behind = ending is not None and place > index and tokens[place].line != ending
        if depth <= 0 and is_first and (is_behind or _begins(tokens, place, prompted)):
            return place
        depth += opened(tokens, place)
        is_end = place >= index and depth <= 0 and tokens[place].type in TERMINATORS
        if is_end and tokens[place].line != ending:
            return place + 1
    # A loop or a procedure has no end: its statements are read one by one.
    return next((k + 1 for k in range(begin, len(tokens)) if tokens[k].type in TERMINATORS), len(tokens))


def _ending_line(tokens: Sequence[Token], begin: int, index: int) -> int | None:
    """Return the line at whose end a command of the system or an unclosed string ends; None if there is neither."""
    is_string = index < len(tokens) and tokens[index] in _STRING_MARKS
    return tokens[index if is_string else begin].line if is_string or tokens[begin] == "!" else None


def _begins(tokens: Sequence[Token], place: int, prompted: Collection[int]) -> bool:
    """Whether a line begins a statement: an assignment, or a complete statement after a prompt."""
    if tokens[place].type in _STATEMENTS or _is_assigned(tokens, place):
        return True
    if tokens[place].line not in prompted or tokens[place].type in _SIGNS:
        return False
    text = tokens[place : place + _LONGEST]
    line = [token for token in text if token.line == text[0].line]
    return is_statement(line) or isinstance(next_statement(text), Parsed)


def _is_assigned(tokens: Sequence[Token], place: int) -> bool:
    """Whether a line begins with the target of an assignment and closes no bracket of an earlier line."""
    depth, is_target, line = 0, False, tokens[place].line
    for token in tokens[place:]:
        if token.line != line or (is_target and token.type in TERMINATORS):
            break
        if token == ":=" and not depth:
            is_target = True
        elif not is_target and token.type not in _OF_TARGETS and token != "||":
            return False
        depth += (token.type in OPENING) - (token.type in CLOSING)
        if depth < 0:
            return False
    return is_target
