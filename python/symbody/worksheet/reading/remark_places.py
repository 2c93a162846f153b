"""Where a remark can stand that keeps a statement from being read: behind separators, operands and operators."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from lark import Token

from symbody.worksheet.reading.parse import TERMINATORS, Parsed, next_statement
from symbody.worksheet.reading.prose import CLOSING, LITERALS, OPENING, WORDS, stands_far

__all__ = ["SEPARATORS", "Span", "candidates"]

SEPARATORS = TERMINATORS | {"COMMA", "LPAR", "LSQB", "LBRACE", "THEN", "DO", "ELSE"}
_OPERATORS = frozenset({"PLUS", "MINUS", "TIMES", "OVER", "DOT", "EQUAL"})

#: How many places are tried for the beginning of a remark.
_TRIALS = 6


@dataclass(frozen=True, slots=True)
class Span:
    """Tokens from ``begin`` to the one before ``end``."""

    begin: int
    end: int


def candidates(tokens: Sequence[Token], begin: int, index: int) -> Iterator[Span]:
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
        depth += (tokens[place].type in CLOSING) - (tokens[place].type in OPENING)
        if depth < 0 and tokens[place].type == "LPAR":
            before = tokens[place - 1]
            is_apart = before.line == line and before.end_column != tokens[place].column
            end = _behind_bracket(tokens, place)
            if end and is_apart and before.type in CLOSING | {"INTEGER", "DECIMAL", "NAME"}:
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
    while first > begin and tokens[first - 1].type in WORDS and tokens[first - 1].line == tokens[index].line:
        first -= 1
    is_behind = first > begin + 1 and end - first > 1 and tokens[first - 1].type in _OPERATORS
    if is_behind and _space(tokens, first - 1) >= _space(tokens, first):  # else the first word is the operand
        rest = [*tokens[begin:first], *tokens[end:]]
        is_sign = end < len(tokens) and tokens[end].type in {"PLUS", "MINUS"}
        if not is_sign and isinstance(next_statement(rest), Parsed):
            yield Span(first, end)


def _space(tokens: Sequence[Token], index: int) -> int:
    """Return the number of characters between a token and the next one of its line."""
    return (tokens[index + 1].column or 0) - (tokens[index].end_column or 0)


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
        if separator != begin and tokens[separator - 1].type not in SEPARATORS:
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
        if before.type in LITERALS and not _space(tokens, place - 1):  # 2nd is one word
            if tokens[place - 2].type in CLOSING | {"NAME"}:
                yield Span(place - 1, end)
            continue
        is_factor = before.type in LITERALS and end == place + 1 and not stands_far(before, tokens[place])
        if before.type in CLOSING | LITERALS | {"NAME"} and tokens[place].type == "NAME" and not is_factor:
            yield Span(place, end)


def _depths(tokens: Sequence[Token]) -> list[int]:
    """Return how many brackets are open before the first token, and behind each."""
    depths = [0]
    for token in tokens:
        depths.append(depths[-1] + (token.type in OPENING) - (token.type in CLOSING))
    return depths


def _line_end(tokens: Sequence[Token], index: int) -> int:
    """Return the end of a token's line; the end of the cell, a terminator without text, doesn't belong to it."""
    end = index
    while end < len(tokens) and tokens[end].line == tokens[index].line and tokens[end]:
        end += 1
    return end
