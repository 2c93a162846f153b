"""Remarks that lost their ``#``: what is no code, though it stands among code.

Texts exported from old sheets have prose behind a terminator, behind a comma, and on lines of its own inside an open
bracket. What can't continue a statement is a remark up to the end of its line, from the last separator on.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise

from lark import Token

from symbody.worksheet.reading.parse import TERMINATORS, Failure, Parsed, is_statement, next_statement
from symbody.worksheet.reading.remark_behind_code import begins_with_code, stands_far, tails
from symbody.worksheet.sheet import syntax

__all__ = [
    "Span",
    "is_trailing_remark",
    "remark_in",
    "used_names",
    "words_before_code",
    "words_before_end",
]

_KEYWORDS = """IF THEN ELIF ELSE FOR DO IN AND OR NOT XOR UNION WITHOUT INTERSECT SUBSET MOD CLAUSE HEADED DECLARED READ
SAVE STOP DONE QUIT NEXT BREAK RETURN ERROR TRY CATCH FINALLY END ASSUMING IMPLIES USE"""
_WORDS = frozenset(_KEYWORDS.split()) | {"NAME"}
_OPERANDS = _WORDS | {"STRING", "INTEGER", "DECIMAL", "BACKQUOTED"}
_SEPARATORS = TERMINATORS | {"COMMA", "LPAR", "LSQB", "LBRACE", "THEN", "DO", "ELSE"}
_MARKS = frozenset({"COMMA", "SEMICOLON", "COLON", "MINUS", "DOT", "UNKNOWN"})  # of prose, too
_ENDS = frozenset({"OD", "END", "FI"})  # of loops and conditions
_OPENING = frozenset({"LPAR", "LSQB", "LBRACE"})
_CLOSING = frozenset({"RPAR", "RSQB", "RBRACE"})
_LITERALS = frozenset({"INTEGER", "DECIMAL"})
_OPERATORS = frozenset({"PLUS", "MINUS", "TIMES", "OVER", "DOT", "EQUAL"})

#: How many places are tried for the beginning of a remark.
_TRIALS = 6


@dataclass(frozen=True, slots=True)
class Span:
    """Tokens from ``begin`` to the one before ``end``."""

    begin: int
    end: int


def used_names(tokens: Iterable[Sequence[Token]]) -> frozenset[str]:
    """Return the names that occur in code: beside an operator or a bracket. Each item holds the tokens of a line."""
    return frozenset(str(line[i]) for line in tokens for i in range(len(line)) if _is_used(line, i))


def _is_used(line: Sequence[Token], index: int) -> bool:
    if line[index].type not in {"NAME", "BACKQUOTED"}:
        return False
    kinds = [line[k].type for k in (index - 1, index + 1) if 0 <= k < len(line)]
    return not any(kind in _WORDS for kind in kinds) and any(kind not in _MARKS for kind in kinds)


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
    for span in _candidates(tokens, begin, failure.index):
        for part in _behind_code(tokens, begin, span, used):
            if _helps(tokens, begin, part, failure.index):
                return part
        within = span.begin > begin and tokens[span.begin - 1].type not in TERMINATORS
        if within and begins_with_code(tokens, span.begin, span.end, used):
            continue
        if not _is_prose(tokens, span, begin):
            continue
        span = _with_bare_words(tokens, span, begin, used)  # noqa: PLW2901 - the same remark, longer
        if span.begin == begin or _helps(tokens, begin, span, failure.index):
            return span
    return None


def _behind_code(tokens: Sequence[Token], begin: int, span: Span, used: Collection[str]) -> Iterator[Span]:
    """Return the words behind code in a span that is a part of a statement; a comma at their end may be code."""
    text = tokens[span.begin : span.end]
    if not text or (span.begin == begin and not any(token == ":=" for token in text)):
        return
    for place in tails(text, _WORDS | _MARKS - TERMINATORS, used):
        yield Span(span.begin + place, span.end)
        if text[-1].type == "COMMA":
            yield Span(span.begin + place, span.end - 1)


def words_before_code(tokens: Sequence[Token], begin: int) -> Span | None:
    """Return words side by side between two statements of a line: ``x := a^2: square of it; y := 4;``."""
    if not begin or tokens[begin - 1].line != tokens[begin].line:
        return None
    end = begin
    while end < len(tokens) and tokens[end].type in _WORDS and tokens[end].line == tokens[begin].line:
        end += 1
    is_ended = end < len(tokens) and tokens[end].type in TERMINATORS
    return Span(begin, end + 1) if end > begin + 1 and is_ended else None


def words_before_end(
    tokens: Sequence[Token], begin: int, end: int, used: Callable[[], Collection[str]]
) -> Span | None:
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
        if is_behind and is_alone and not others.union(used()).intersection(tokens[first:closing]):
            return Span(first, closing)
    return None


def _candidates(tokens: Sequence[Token], begin: int, index: int) -> Iterator[Span]:
    """Return where the remark can stand: it ends with the line of the wrong token, or with the line before."""
    last = min(index, len(tokens) - 1)
    ends = [_line_end(tokens, last)]
    yield from _in_brackets(tokens, begin, last)
    if begin < index <= last and (tokens[index].line != tokens[index - 1].line or not tokens[index]):
        ends.insert(0, index)
    for end in ends:
        if _is_tail(tokens, begin, end):
            yield Span(begin, end)
        yield from _behind_separators(tokens, begin, min(index, end - 1), end)
    yield from _behind_operands(tokens, begin, last, ends[-1])
    if (
        begin < last and tokens[last].line != tokens[last - 1].line
    ):  # a line of its own behind a complete operand
        yield Span(last, ends[-1])
    yield from _behind_operator(tokens, begin, last)


def _in_brackets(tokens: Sequence[Token], begin: int, index: int) -> Iterator[Span]:
    """Return words in brackets apart from a complete operand: ``f := sin(q)  (sine of q)``."""
    line, depth = tokens[index].line, 0
    for place in range(index - 1, begin, -1):
        if tokens[place].line != line:
            return
        depth += (tokens[place].type in _CLOSING) - (tokens[place].type in _OPENING)
        if depth < 0 and tokens[place].type == "LPAR":
            before = tokens[place - 1]
            is_apart = before.line == line and before.end_column != tokens[place].column
            end = _behind_bracket(tokens, place)
            if end and is_apart and before.type in _CLOSING | {"INTEGER", "DECIMAL", "NAME"}:
                yield Span(place, end)
            return


def _behind_bracket(tokens: Sequence[Token], begin: int) -> int | None:
    """Return the end of the line that a bracket closes; None if there is more on it than a terminator."""
    end = _line_end(tokens, begin)
    while end > begin and tokens[end - 1].type in TERMINATORS:
        end -= 1
    depths = _depths(tokens[begin:end])
    return end if len(depths) > 2 and not depths[-1] and all(depths[1:-1]) else None


def _behind_operator(tokens: Sequence[Token], begin: int, index: int) -> Iterator[Span]:
    """Return words between an operator and the operand on the next line: ``y := x1 +  the offset``, then ``x2;``."""
    end = _line_end(tokens, index)
    first = end
    while first > begin and tokens[first - 1].type in _WORDS and tokens[first - 1].line == tokens[index].line:
        first -= 1
    if first > begin + 1 and end - first > 1 and tokens[first - 1].type in _OPERATORS:
        rest = [*tokens[begin:first], *tokens[end:]]
        if isinstance(next_statement(rest), Parsed):
            yield Span(first, end)


def _is_tail(tokens: Sequence[Token], begin: int, end: int) -> bool:
    """Whether the tokens are what follows the last terminator of their line."""
    text = tokens[begin:end]
    return (
        bool(begin)
        and bool(text)
        and tokens[begin - 1].line == text[-1].line
        and not any(token.type in TERMINATORS for token in text)
        and _depths(text)[-1] == 0
    )


def _behind_separators(tokens: Sequence[Token], begin: int, index: int, end: int) -> Iterator[Span]:
    line = tokens[end - 1].line
    trials = 0
    for separator in range(index, begin - 1, -1):
        if separator != begin and tokens[separator - 1].type not in _SEPARATORS:
            continue
        if separator == begin or min(_depths(tokens[separator:index])) >= 0:
            yield Span(separator, end)
        trials += 1
        if trials == _TRIALS or tokens[separator].line != line:
            break


def _behind_operands(tokens: Sequence[Token], begin: int, index: int, end: int) -> Iterator[Span]:
    """Return where a remark can stand behind a complete operand: ``f(x) = 0   the first equation``."""
    for place in range(index, max(begin, index - _TRIALS), -1):
        if tokens[place - 1].line != tokens[place].line:
            return
        before = tokens[place - 1]
        is_factor = before.type in _LITERALS and end == place + 1 and not stands_far(before, tokens[place])
        if before.type in _CLOSING | _LITERALS | {"NAME"} and tokens[place].type == "NAME" and not is_factor:
            yield Span(place, end)


def _depths(tokens: Sequence[Token]) -> list[int]:
    """Return how many brackets are open before the first token, and behind each."""
    depths = [0]
    for token in tokens:
        depths.append(depths[-1] + (token.type in _OPENING) - (token.type in _CLOSING))
    return depths


def _line_end(tokens: Sequence[Token], index: int) -> int:
    """Return the end of a token's line; the end of the cell, a terminator without text, doesn't belong to it."""
    end = index
    while end < len(tokens) and tokens[end].line == tokens[index].line and tokens[end]:
        end += 1
    return end


def _is_prose(tokens: Sequence[Token], span: Span, begin: int) -> bool:
    """Whether tokens read as prose: words side by side, signs that mean nothing, or words alone."""
    text = tokens[span.begin : span.end]
    if not text or any(token == ":=" for token in text):
        return False
    if span.begin > begin and text[-1].type == "SEMICOLON":  # the end of a statement with a missing bracket
        return False
    at_line_start = span.begin == begin and (not begin or tokens[begin - 1].line != text[0].line)
    if at_line_start:  # a statement with a mistake in it is no remark
        first = text[:2]
        return (
            text[-1].type != "SEMICOLON"
            and len(first) == 2
            and first[0].type in {"NAME", "UNKNOWN"}
            and _is_prose_sign(first[1])
        )
    if any(_is_code(piece) for piece in _pieces(text)[1:]):  # behind a mistake, the line goes on with code
        return False
    if any(token.type == "UNKNOWN" for token in text):
        return True
    words = [token for token in text if token.type != "QUOTE"]  # 'sin' and 'cos' are words, too
    if all(token.type in _WORDS | _MARKS for token in words):
        return True
    return any(
        {first.type, second.type} <= _OPERANDS and "NAME" in {first.type, second.type}
        for first, second in pairwise(words)
    )


def _pieces(text: Sequence[Token]) -> list[Sequence[Token]]:
    """Return the tokens between terminators."""
    ends = [k for k, token in enumerate(text) if token.type in TERMINATORS]
    return [text[a:b] for a, b in pairwise([0, *(end + 1 for end in ends), len(text) + 1])]


def _is_code(piece: Sequence[Token]) -> bool:
    """Whether tokens are a statement, and more than words."""
    return any(token.type not in _WORDS | _MARKS for token in piece) and is_statement(piece)


def _is_prose_sign(token: Token) -> bool:
    return token.type in _WORDS or token.type == "UNKNOWN"


def _with_bare_words(tokens: Sequence[Token], span: Span, begin: int, used: Collection[str]) -> Span:
    """Return the remark with the words before it that occur nowhere in code: ``show(AB), rocker, the second link``."""
    first = span.begin
    while (
        first - 2 > begin
        and tokens[first - 1].type == "COMMA"
        and tokens[first - 2].type == "NAME"
        and tokens[first - 2] not in used
        and tokens[first - 3].type in _SEPARATORS
    ):
        first -= 2
    return Span(first, span.end)


def _helps(tokens: Sequence[Token], begin: int, span: Span, index: int) -> bool:
    """Whether the statement can be read on behind a remark."""
    rest = [*tokens[begin : span.begin], *tokens[span.end :]]
    found = next_statement(rest)
    if isinstance(found, Parsed) or found.index > span.begin - begin:
        return True
    only_end_is_missing = found.index < len(rest) and not rest[found.index]
    return (only_end_is_missing and bool(tokens[index])) or _is_whole(tokens, begin, span)


def _is_whole(tokens: Sequence[Token], begin: int, span: Span) -> bool:
    """Whether a remark in brackets stands between a whole statement, without a terminator, and the next line."""
    is_last = tokens[span.begin].type == "LPAR" and span.end < len(tokens)
    is_last = is_last and tokens[span.end].line != tokens[span.end - 1].line
    return is_last and is_statement(tokens[begin : span.begin])
