"""Remarks that lost their ``#``: what is no code, though it stands among code.

Texts exported from old sheets have prose behind a terminator, behind a comma, and on lines of its own inside an open
bracket. What can't continue a statement is a remark up to the end of its line, from the last separator on.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from itertools import pairwise

from lark import Token

from symbody.worksheet.reading.numbered_text import is_numbered
from symbody.worksheet.reading.parse import TERMINATORS, Failure, Parsed, is_statement, next_statement
from symbody.worksheet.reading.prose import (
    CLOSING,
    MARKS,
    WORDS,
    has_bracketed_word,
    is_prose,
    is_word_with_unit,
)
from symbody.worksheet.reading.remark_behind_code import begins_with_code, tails
from symbody.worksheet.reading.remark_places import SEPARATORS, Span, candidates
from symbody.worksheet.sheet import syntax

__all__ = [
    "is_trailing_remark",
    "remark_in",
    "words_before_code",
    "words_before_end",
]

_SIGNS = frozenset({"PLUS", "MINUS"})
_OPERATORS = _SIGNS | {"TIMES", "OVER", "POWER", "EQUAL"}
_ENDS = frozenset({"OD", "END", "FI"})  # of loops and conditions


def is_trailing_remark(tokens: Sequence[Token], begin: int, found: Parsed) -> bool:
    """Whether a statement that only the end of the cell ends is text behind the last terminator of its line."""
    if tokens[found.end - 1] or not begin or tokens[begin - 1].line != tokens[begin].line:
        return False
    statement = found.statement
    match statement:
        case syntax.Assignment():
            return False
        case syntax.Evaluation(expression=syntax.Call(arguments=arguments)):
            return not arguments or arguments == (syntax.Name("t", place=statement.place),)
    return isinstance(statement, syntax.Evaluation)


def remark_in(tokens: Sequence[Token], begin: int, failure: Failure, used: Collection[str]) -> Span | None:
    """Return the remark that keeps the statement at ``begin`` from being read, if there is one."""
    for span in candidates(tokens, begin, failure.index):
        if span.begin == span.end:
            continue
        for part in _behind_code(tokens, begin, span, used):
            part = _with_bare_words(tokens, part, begin, used)  # noqa: PLW2901 - the same remark, longer
            if _helps(tokens, begin, part, failure.index):
                return part
        if tokens[span.begin].line != tokens[span.end - 1].line:  # a remark ends with its line
            continue
        text = tokens[span.begin : span.end]
        is_unit = has_bracketed_word(text, used) or is_word_with_unit(text)
        if (
            _is_within(tokens, begin, span)
            and begins_with_code(tokens, span.begin, span.end, used)
            and not is_unit
        ):
            continue
        if not _is_text(tokens, span, begin, used):
            continue
        span = _with_bare_words(tokens, span, begin, used)  # noqa: PLW2901 - the same remark, longer
        if span.begin == begin or _helps(tokens, begin, span, failure.index):
            return span
    return _before_terminator(tokens, begin, failure.index, used)


def _before_terminator(tokens: Sequence[Token], begin: int, index: int, used: Collection[str]) -> Span | None:
    """Return words between the last comma of a whole statement and its terminator: ``total := d + e, all of them;``."""
    last = min(index, len(tokens) - 1)
    line = tokens[last].line
    end = next((k for k in range(last, len(tokens)) if tokens[k].type in TERMINATORS), len(tokens))
    comma = next((k for k in range(last, begin, -1) if tokens[k].type == "COMMA"), begin)
    text = tokens[comma + 1 : end]
    if end == len(tokens) or comma == begin or tokens[end].line != line or tokens[comma].line != line:
        return None
    is_words = len(text) > 1 and all(token.type in WORDS for token in text) and text[0].type == "NAME"
    is_new = not any(token in used for token in text)
    return Span(comma, end) if is_words and is_new and is_statement(tokens[begin:comma]) else None


def _is_within(tokens: Sequence[Token], begin: int, span: Span) -> bool:
    """Whether a span is a part of a statement, or a line of its own, and not what follows a terminator on its line."""
    before = tokens[span.begin - 1]
    return span.begin > begin and not (before.type in TERMINATORS and before.line == tokens[span.begin].line)


def _behind_code(tokens: Sequence[Token], begin: int, span: Span, used: Collection[str]) -> Iterator[Span]:
    """Return the words behind code in a span that is a part of a statement; a comma at their end may be code."""
    text = tokens[span.begin : span.end]
    if span.begin == begin and not any(token == ":=" for token in text):
        return
    for place in tails(text, WORDS | MARKS - TERMINATORS, used):
        yield Span(span.begin + place, span.end)
        if text[-1].type == "COMMA":
            yield Span(span.begin + place, span.end - 1)


def words_before_code(tokens: Sequence[Token], begin: int) -> Span | None:
    """Return words side by side between two statements of a line: ``x := a^2: square of it; y := 4;``."""
    if not begin or tokens[begin - 1].line != tokens[begin].line:
        return None
    end = begin
    while end < len(tokens) and tokens[end].type in WORDS and tokens[end].line == tokens[begin].line:
        end += 1
    is_ended = end < len(tokens) and tokens[end].type in TERMINATORS
    return Span(begin, end + 1) if end > begin + 1 and is_ended else None


def words_before_end(tokens: Sequence[Token], begin: int, end: int, used: Collection[str]) -> Span | None:
    """Return words behind the last terminator of a line within a loop that ends on the next line.

    They would be the last statement of the loop; none of them occurs elsewhere in the code of the sheet (``used``).
    """
    for closing in range(begin + 2, end):
        if tokens[closing].type not in _ENDS or tokens[closing - 1].type != "NAME":
            continue
        first = closing
        while tokens[first - 1].type == "NAME" and tokens[first - 1].line == tokens[closing - 1].line:
            first -= 1
        is_behind = tokens[first - 1].type in TERMINATORS and tokens[first - 1].line == tokens[first].line
        is_alone = tokens[closing - 1].line != tokens[closing].line
        others = {*tokens[:first], *tokens[closing:]}
        if is_behind and is_alone and not others.union(used).intersection(tokens[first:closing]):
            return Span(first, closing)
    return None


def _is_text(tokens: Sequence[Token], span: Span, begin: int, used: Collection[str]) -> bool:
    """Whether tokens read as prose: words side by side, signs that mean nothing, or words alone."""
    text = tokens[span.begin : span.end]
    if not text or any(token == ":=" for token in text):
        return False
    if span.begin > begin and text[-1].type == "SEMICOLON":  # the end of a statement with a missing bracket
        return False
    at_line_start = span.begin == begin and (not begin or tokens[begin - 1].line != text[0].line)
    if at_line_start:  # a statement with a mistake in it is no remark
        first = text[:2]
        return is_numbered(text, used) or (
            text[-1].type != "SEMICOLON"
            and len(first) == 2
            and first[0].type in {"NAME", "UNKNOWN"}
            and _is_prose_sign(first[1])
        )
    if any(_is_code(piece) for piece in _pieces(text)[1:]):  # behind a mistake, the line goes on with code
        return False
    is_behind_operand = tokens[span.begin - 1].type in CLOSING | {"NAME"} and text[0].type == "NAME"
    return (
        is_prose(text)
        or has_bracketed_word(text, used)
        or (span.begin > begin and tokens[span.begin - 1].type == "COMMA" and is_word_with_unit(text))
        or (is_behind_operand and text[-1].type in CLOSING)
    )  # deflection [m]


def _pieces(text: Sequence[Token]) -> list[Sequence[Token]]:
    """Return the tokens between terminators."""
    ends = [k for k, token in enumerate(text) if token.type in TERMINATORS]
    return [text[a:b] for a, b in pairwise([0, *(end + 1 for end in ends), len(text) + 1])]


def _is_code(piece: Sequence[Token]) -> bool:
    """Whether tokens are a statement, and more than words."""
    return any(token.type not in WORDS | MARKS for token in piece) and is_statement(piece)


def _is_prose_sign(token: Token) -> bool:
    return token.type in WORDS or token.type == "UNKNOWN"


def _with_bare_words(tokens: Sequence[Token], span: Span, begin: int, used: Collection[str]) -> Span:
    """Return the remark with the words before it that occur nowhere in code: ``show(AB), rocker, the second link``.

    So is an equals sign with the word behind it: ``T := subs(data, RF) = mass of the car``.
    """
    first = span.begin
    while (
        first - 2 > begin
        and tokens[first - 1].type == "COMMA"
        and tokens[first - 2].type == "NAME"
        and tokens[first - 2] not in used
        and tokens[first - 3].type in SEPARATORS
    ):
        first -= 2
    is_word = first - 2 > begin and tokens[first - 1].type == "NAME" and tokens[first - 1] not in used
    return Span(first - 2 if is_word and tokens[first - 2].type == "EQUAL" else first, span.end)


def _helps(tokens: Sequence[Token], begin: int, span: Span, index: int) -> bool:
    """Whether the statement can be read on behind a remark."""
    if tokens[span.begin - 1].type in _OPERATORS and tokens[span.end].type in _SIGNS:  # a * + b
        return False
    rest = [*tokens[begin : span.begin], *tokens[span.end :]]
    found = next_statement(rest)
    if isinstance(found, Parsed) or found.index > span.begin - begin:
        return True
    only_end_is_missing = found.index < len(rest) and not rest[found.index]
    is_before_end = index < len(tokens) and bool(tokens[index])
    return (only_end_is_missing and is_before_end) or _is_whole(tokens, begin, span)


def _is_whole(tokens: Sequence[Token], begin: int, span: Span) -> bool:
    """Whether a remark in brackets stands between a whole statement, without a terminator, and the next line."""
    is_last = tokens[span.begin].type == "LPAR" and span.end < len(tokens)
    is_last = is_last and tokens[span.end].line != tokens[span.end - 1].line
    return is_last and is_statement(tokens[begin : span.begin])
