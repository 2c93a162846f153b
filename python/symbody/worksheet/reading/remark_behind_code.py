"""Remarks without their ``#`` behind code on one line: the code stays, the words behind it are the remark.

``V := K/2*(x^2 +  spring in x`` before a line ``y^2);`` keeps ``x^2 +``; ``(z^2  springs`` before ``+ y^2)`` keeps
``z^2``.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence

from lark import Token

from symbody.worksheet.reading.prose import CLOSING, LITERALS, stands_far

__all__ = ["begins_with_code", "tails"]

_CALCULATION = frozenset({"POWER", "TIMES", "OVER", "PLUS"})
_OPERAND_ENDS = CLOSING | LITERALS | {"NAME"}
_OPERATORS = frozenset({"PLUS", "MINUS", "TIMES", "OVER", "EQUAL", "COMMA"})


def tails(text: Sequence[Token], words: Collection[str], used: Collection[str]) -> Iterator[int]:
    """Return where words can begin that end a line behind code, the longest first. ``words`` are kinds of tokens.

    Behind an operator they are two or more, since one is an operand. The first is no name of the code (``used``).
    """
    end = first = len(text)
    while first > 1 and text[first - 1].type in words and text[first - 1].line == text[-1].line:
        first -= 1
    for place in range(first, end):
        before, word = text[place - 1], text[place]
        if word.type != "NAME" or word in used or before.line != word.line or _is_glued(before, word):
            continue
        if before.type in _OPERATORS:
            is_tail = (
                end - place > 1 and text[place + 1].type not in _OPERATORS and not _is_operand(text, place)
            )
        else:
            is_tail = before.type in _OPERAND_ENDS and _is_apart(text, place, used)
        if is_tail and (stands_far(before, word) or _has_code(text[:place], used)):
            yield place


def begins_with_code(tokens: Sequence[Token], begin: int, end: int, used: Collection[str]) -> bool:
    """Whether text up to the first two words side by side is code: it calculates, or calls or names something.

    So does ``b^2  the force``. A name of the code may be a word, too: ``a`` in ``[x,  a wheel``.
    """
    if _is_name_of_code(tokens, begin, end, used):
        return True
    for place in range(begin, end):
        kind = tokens[place].type
        is_number = kind == "EQUAL" and place + 1 < end and tokens[place + 1].type in LITERALS
        if kind in _CALCULATION or is_number or (kind == "LPAR" and _is_call(tokens, place, used)):
            return True
        if place > begin and kind == "NAME" and tokens[place - 1].type in _OPERAND_ENDS:
            return False
    return False


def _is_name_of_code(tokens: Sequence[Token], begin: int, end: int, used: Collection[str]) -> bool:
    """Whether a name of the code begins the text, nearer to what stands before it than to the next word."""
    if tokens[begin] not in used or begin + 1 == end:
        return False
    if tokens[begin + 1].type != "NAME":
        return tokens[begin + 1] != "(" or _is_call(tokens, begin + 1, used)
    is_apart = tokens[begin - 1].line != tokens[begin].line or not _is_operand(tokens, begin)
    return stands_far(tokens[begin], tokens[begin + 1]) or not is_apart


def _is_call(tokens: Sequence[Token], bracket: int, used: Collection[str]) -> bool:
    name = tokens[bracket - 1]
    return name.type == "NAME" and name in used and name.end_column == tokens[bracket].column


def _is_apart(text: Sequence[Token], place: int, used: Collection[str]) -> bool:
    """Whether the operand before a word is code: ``2 y`` is a product, and ``the link`` may be one remark."""
    before = text[place - 1]
    if stands_far(before, text[place]):
        return True
    return before in used if before.type == "NAME" else before.type in CLOSING or place + 1 < len(text)


def _is_operand(tokens: Sequence[Token], place: int) -> bool:
    """Whether a word is nearer to the operator before it than to the word behind it: ``-m*g  weight``."""
    return _space(tokens[place - 1], tokens[place]) < _space(tokens[place], tokens[place + 1])


def _is_glued(before: Token, word: Token) -> bool:
    """Whether a number and a word are one word: ``2nd``."""
    return before.type in LITERALS and not _space(before, word)


def _has_code(text: Sequence[Token], used: Collection[str]) -> bool:
    """Whether text before a remark has more than words of its own."""
    return any(token.type not in {"NAME", "COMMA"} or token in used for token in text)


def _space(one: Token, two: Token) -> int:
    """Return the number of characters between two tokens of a line."""
    return (two.column or 0) - (one.end_column or 0)
