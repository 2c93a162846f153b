"""Which tokens read as prose: words side by side, signs that mean nothing, or words alone."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from itertools import pairwise

from lark import Token

__all__ = [
    "CLOSING",
    "LITERALS",
    "MARKS",
    "OPENING",
    "WORDS",
    "begins_with_words",
    "has_bracketed_word",
    "has_words_side_by_side",
    "holds_code",
    "is_prose",
    "is_used",
    "is_word_with_unit",
    "stands_far",
]

_KEYWORDS = """IF THEN ELIF ELSE FOR DO IN AND OR NOT XOR UNION WITHOUT INTERSECT SUBSET MOD CLAUSE HEADED DECLARED READ
SAVE STOP DONE QUIT NEXT BREAK RETURN ERROR TRY CATCH FINALLY END ASSUMING IMPLIES USE"""
WORDS = frozenset(_KEYWORDS.split()) | {"NAME"}
MARKS = frozenset({"COMMA", "SEMICOLON", "COLON", "MINUS", "DOT", "UNKNOWN"})  # of prose, too
LITERALS = frozenset({"INTEGER", "DECIMAL"})
OPENING = frozenset({"LPAR", "LSQB", "LBRACE"})
CLOSING = frozenset({"RPAR", "RSQB", "RBRACE"})
_OPERANDS = WORDS | LITERALS | {"STRING", "BACKQUOTED"}
_INFIX = frozenset(
    {"AND", "OR", "NOT", "XOR", "UNION", "WITHOUT", "INTERSECT", "SUBSET", "MOD", "IN", "ASSUMING", "IMPLIES"}
)
_OF_UNITS = frozenset({"INTEGER", "OVER", "TIMES", "POWER", "MINUS", "DOT"})
_CALCULATIONS = frozenset({"POWER", "TIMES", "OVER", "PLUS", "EQUAL"})

#: How many characters apart words are that don't belong together.
_GAP = 2


def is_prose(text: Sequence[Token]) -> bool:
    """Whether tokens read as prose."""
    if any(token.type == "UNKNOWN" for token in text):
        return True
    return all(token.type in WORDS | MARKS | {"QUOTE"} for token in text) or _are_side_by_side(
        text, _OPERANDS
    )


def has_words_side_by_side(text: Sequence[Token]) -> bool:
    """Whether two operands stand side by side, or a sign has no meaning: no code has that."""
    is_behind_bracket = any(one.type in CLOSING and two.type == "NAME" for one, two in pairwise(text))
    has_sign = any(token.type == "UNKNOWN" for token in text)
    return has_sign or is_behind_bracket or _are_side_by_side(text, _OPERANDS - _INFIX)


def _are_side_by_side(text: Sequence[Token], kinds: frozenset[str]) -> bool:
    words = [token for token in text if token.type != "QUOTE"]  # 'sin' and 'cos' are words, too
    return any(
        {first.type, second.type} <= kinds and "NAME" in {first.type, second.type}
        for first, second in pairwise(words)
    )


def begins_with_words(text: Sequence[Token]) -> bool:
    """Whether a line begins with two words, or signs of prose, behind words with commas: ``length, width and``."""
    first = 0
    while len(text) > first + 2 and text[first].type == "NAME" and text[first + 1].type == "COMMA":
        first += 2
    start = text[first : first + 2]
    if len(start) == 1:
        return start[0].type == "UNKNOWN"
    return (
        len(start) == 2
        and start[0].type in {"NAME", "UNKNOWN", "CLAUSE"} | LITERALS
        and (start[1].type in WORDS or start[1].type == "UNKNOWN")
        and (start[0].type not in LITERALS or start[1].type == "NAME")
    )


def has_bracketed_word(text: Sequence[Token], used: Collection[str]) -> bool:
    """Whether a text is words or a unit in brackets, then a word that the code doesn't use: ``(m) lateral``."""
    end = next((k for k, token in enumerate(text) if token.type in CLOSING), 0)
    inner = text[1:end]
    if text[0].type not in OPENING or not any(token.type == "NAME" for token in inner):
        return False
    if not all(token.type in WORDS | _OF_UNITS for token in inner) or end + 1 == len(text):
        return False
    return text[end + 1].type == "NAME" and text[end + 1] not in used


def is_word_with_unit(text: Sequence[Token]) -> bool:
    """Whether a text is words and, apart, a unit in brackets: ``stiffness (N/m)``; ``y (t)`` is a function."""
    first = next((k for k, token in enumerate(text) if token.type in OPENING), 0)
    inner = text[first + 1 : -1]
    is_unit = bool(inner) and all(token.type in WORDS | _OF_UNITS for token in inner) and [*inner] != ["t"]
    return (
        first > 0
        and text[first].type == "LPAR"
        and text[-1].type in CLOSING
        and all(token.type == "NAME" for token in text[:first])
        and text[first - 1].end_column != text[first].column
        and is_unit
    )


def is_used(line: Sequence[Token], index: int) -> bool:
    """Whether a name stands beside an operator or a bracket."""
    if line[index].type not in {"NAME", "BACKQUOTED"}:
        return False
    if index + 1 < len(line) and line[index + 1] == ":=":
        return True
    is_behind_operand = index > 0 and line[index - 1].type in CLOSING | LITERALS | {"NAME"}
    is_before_number = index + 1 < len(line) and line[index + 1].type in LITERALS
    if is_behind_operand or is_before_number:  # a word of prose
        return False
    kinds = [line[k].type for k in (index - 1, index + 1) if 0 <= k < len(line)]
    return not any(kind in WORDS for kind in kinds) and any(kind not in MARKS for kind in kinds)


def holds_code(text: Sequence[Token], used: Collection[str]) -> bool:
    """Whether a remark may have been meant as code: it calculates, or begins with an item or a name of the code.

    A bracket may be an index or an item: ``a  [m]`` and ``x, (m) lateral``, where m is a name of the code.
    """
    if any(token.type in _CALCULATIONS or token == ":=" for token in text):
        return True
    if text[0].type in OPENING and len(text) > 1:
        return text[1] in used
    if text[0].type not in LITERALS | {"NAME"}:
        return False
    if len(text) == 1:
        return text[0].type in LITERALS or text[0] in used
    is_item = text[1].type == "COMMA"
    return is_item or (text[0] in used and text[1].type in OPENING)


def stands_far(one: Token, two: Token) -> bool:
    """Whether two tokens of a line are apart as columns are: by more than one space."""
    return (two.column or 0) - (one.end_column or 0) >= _GAP
