"""Text that a line shows to be no code, before any statement is read.

It stands behind the last terminator of a line (``m := 5; mass [kg]``), on a line of its own between statements, or it
is a unit apart at the end of a line (``x0  [m]``), a word behind a comma before a bracket, or a word far behind an
operator before an operand (``m*a +   inertia`` above ``c*v;``). It is a remark where no statement can be: if two of its
words stand side by side, if none of its names occurs in code, or if it is a unit.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass

from lark import Token

from symbody.worksheet.reading.numbered_text import is_numbered
from symbody.worksheet.reading.parse import TERMINATORS
from symbody.worksheet.reading.prose import (
    CLOSING,
    LITERALS,
    OPENING,
    begins_with_words,
    has_words_side_by_side,
    is_prose,
    stands_far,
)

__all__ = ["loose_part", "without_loose_text"]

#: Words of loops, conditions and procedures: a text with one of them is left to the grammar.
_OF_BLOCKS = frozenset({"DO", "THEN", "OD", "FI", "END", "PROC", "ELSE", "ELIF", "TRY", "CATCH", "FINALLY"})

#: What begins a statement that needs no terminator before the end of a block, or a command of the system.
_BEGINS = frozenset({"RETURN", "ERROR", "READ", "SAVE", "NEXT", "BREAK", "STOP", "QUIT", "DONE", "USE"})
_BEGINS |= {"DECLARED", "HEADED", "FACTORIAL"}

#: What goes on with the line before, or asks for a line behind it.
_OPERATOR_NAMES = """PLUS MINUS TIMES OVER DOT AMPERSAND POWER EQUAL UNEQUAL LESS AT_MOST GREATER AT_LEAST AND OR UNION
WITHOUT INTERSECT COMMA"""
_OPERATORS = frozenset(_OPERATOR_NAMES.split())
_GOES_ON = _OPERATORS | CLOSING | TERMINATORS | {"DO", "THEN", "CLAUSE", "IN"}
_CALCULATES = frozenset({"PLUS", "MINUS", "TIMES", "OVER", "DOT", "EQUAL"})
_OPERANDS = OPENING | LITERALS | {"NAME", "BACKQUOTED", "QUOTE"}
_BEGINS_NOTHING = _OPERATORS - {"PLUS", "MINUS"} | {"_ARROW"}

_UNIT_NAMES = """m mm cm km kg g t N kN Nm Nmm s ms min h rad mrad deg grad rpm Hz kHz J kJ W kW Pa kPa MPa GPa bar K V
A l"""
_UNITS = frozenset(_UNIT_NAMES.split())
_OF_UNITS = frozenset({"NAME", "INTEGER", "OVER", "TIMES", "POWER", "MINUS", "DOT"}) | OPENING | CLOSING


@dataclass(frozen=True, slots=True)
class _Place:
    """Where in a line a text begins, and the lines before and behind it."""

    before: Sequence[Token]
    line: Sequence[Token]
    following: Sequence[Token]
    begin: int


def without_loose_text(
    lines: Sequence[Sequence[Token]],
    used: Collection[str],
    prompted: Collection[int],
    *,
    marks_are_lost: bool,
) -> tuple[list[list[Token]], list[list[Token]]]:
    """Return the lines of code, and the remarks that were taken out of them.

    Args:
        lines: the tokens of each line of a cell.
        used: the names in the code of the sheet.
        prompted: the numbers of the lines behind a prompt, which may be statements without a terminator.
        marks_are_lost: whether remarks without words side by side are looked for.
    """
    code: list[list[Token]] = []
    remarks: list[list[Token]] = []
    for index, line in enumerate(lines):
        following = next((each for each in lines[index + 1 :] if each), ())
        before = next((each for each in reversed(code) if each), ())
        begin = loose_part(before, line, following)
        place = _Place(before, line, following, begin or 0)
        if begin is not None and _is_remark(place, used, prompted, marks_are_lost=marks_are_lost):
            begin = _with_words_before(line, begin, used, marks_are_lost=marks_are_lost)
            remarks.append(list(line[begin:]))
            code.append(list(line[:begin]))
        else:
            code.append(list(line))
    return code, remarks


def loose_part(before: Sequence[Token], line: Sequence[Token], following: Sequence[Token]) -> int | None:
    """Return where the part of a line begins that may be a remark by its place; None if there is none.

    Neither the line before nor the next one needs it, and all brackets in it are closed.
    """
    begin = _behind_terminator(before, line, following)
    begin = _arrow_apart(line, following) if begin is None else begin
    return _unit_apart(line, following) if begin is None else begin


def _behind_terminator(
    before: Sequence[Token], line: Sequence[Token], following: Sequence[Token]
) -> int | None:
    """Return where a text begins behind the last terminator, on its line or on the next one."""
    ends = [index for index, token in enumerate(line) if token.type in TERMINATORS]
    begin = ends[-1] + 1 if ends else 0
    text = line[begin:]
    if not text or not (begin or not before or before[-1].type in TERMINATORS):
        return None
    if not following:  # the end of a cell ends a statement
        return begin if begin and text[0].type in _BEGINS_NOTHING else None
    goes_on = text[-1].type in _OPERATORS or following[0].type in _GOES_ON
    return None if goes_on or _is_code(text) else begin


def _is_code(text: Sequence[Token]) -> bool:
    """Whether a text assigns something, belongs to a loop or a procedure, is a call, or has open brackets."""
    is_call = len(text) > 1 and text[0].type == "NAME" and text[1] == "(" and not _space(text, 0)
    return (
        (is_call and not has_words_side_by_side(text))
        or text[0].type in _BEGINS
        or not _is_closed(text)
        or any(token == ":=" or token.type in _OF_BLOCKS for token in text)
    )


def _arrow_apart(line: Sequence[Token], following: Sequence[Token]) -> int | None:
    """Return where an arrow with words stands apart above a line that goes on: ``a   -> forward`` above ``+ b``."""
    place = next((k for k, token in enumerate(line) if token.type == "_ARROW"), 0)
    if place < 2 or len(line) == place + 1 or not following or following[0].type not in _CALCULATES:
        return None
    operand, words = line[place - 1], line[place + 1 :]
    is_text = stands_far(operand, line[place]) and all(token.type == "NAME" for token in words)
    return place if is_text and operand not in following else None


def _unit_apart(line: Sequence[Token], following: Sequence[Token]) -> int | None:
    """Return where a bracket begins that stands apart at the end of a line, or a word before a bracket below it."""
    begin = _last_operand(line)
    if begin is None or not any(token.type == "NAME" for token in line[begin:]):
        return None
    before = line[begin - 1]
    if _is_between_operator_and_operand(line, begin, following):
        return begin
    if before.type == "COMMA":
        kinds = OPENING if line[begin].type == "NAME" else OPENING | {"NAME"}
        return begin if following and following[0].type in kinds else None
    is_operand = before.type in CLOSING | LITERALS | {"NAME"} and line[begin].type in OPENING
    is_index = before.type not in LITERALS or line[begin].type != "LSQB"
    return begin if is_operand and (not is_index or stands_far(before, line[begin])) else None


def _is_between_operator_and_operand(line: Sequence[Token], begin: int, following: Sequence[Token]) -> bool:
    """Whether a word ends a line far behind an operator, whose operand begins the next line."""
    before, word = line[begin - 1], line[begin]
    is_operator = before.type in _CALCULATES or before == ":="
    is_before_operand = bool(following) and following[0].type in _OPERANDS
    return word.type == "NAME" and is_operator and is_before_operand and stands_far(before, word)


def _last_operand(line: Sequence[Token]) -> int | None:
    """Return where the bracket begins that ends a line, or the name."""
    if len(line) < 2:
        return None
    if line[-1].type == "NAME":
        return len(line) - 1
    depth = 0
    for place in range(len(line) - 1, 0, -1):
        depth += (line[place].type in CLOSING) - (line[place].type in OPENING)
        if not depth:
            return place if line[-1].type in CLOSING else None
    return None


def _is_remark(
    place: _Place, used: Collection[str], prompted: Collection[int], *, marks_are_lost: bool
) -> bool:
    line, begin, text = place.line, place.begin, place.line[place.begin :]
    names = [token for token in text if token.type == "NAME"]
    is_new = bool(names) and not any(name in used for name in names)
    if begin and line[begin - 1].type not in TERMINATORS:  # a unit, or a word
        return is_new or _is_unit(text)
    may_be_last = not place.following or place.following[0].type in _OF_BLOCKS | OPENING
    if begin and (text[0].type in _BEGINS_NOTHING or not may_be_last):  # no statement has no terminator
        return True
    reads_as_prose = has_words_side_by_side(text) if may_be_last else is_prose(text)
    if reads_as_prose and (begin or begins_with_words(text)):
        return True
    is_statement_of_a_prompt = not begin and line[0].line in prompted
    return marks_are_lost and not is_statement_of_a_prompt and (is_new or _is_unit(text))


def _is_unit(text: Sequence[Token]) -> bool:
    """Whether a text is a unit in brackets, perhaps behind a word: ``[m/s^2]``, ``mass [kg]``."""
    unit = text[1:] if text[0].type == "NAME" else text
    names = {str(token) for token in unit if token.type == "NAME"}
    is_bracket = bool(unit) and unit[0].type in OPENING and unit[-1].type in CLOSING
    return is_bracket and bool(names) and names <= _UNITS and all(t.type in _OF_UNITS for t in unit[1:-1])


def _with_words_before(
    line: Sequence[Token], begin: int, used: Collection[str], *, marks_are_lost: bool
) -> int:
    """Return where a remark begins with the words before a colon that belong to it: ``unit: N/m``."""
    is_word = begin > 1 and line[begin - 1].type == "COLON" and line[begin - 2].type == "NAME"
    is_word = is_word and (begin == 2 or line[begin - 3].type in TERMINATORS)
    if is_word and marks_are_lost and line[begin - 2] not in {*used, "restart"}:
        return begin - 2
    is_prose_too = begins_with_words(line[:begin]) or is_numbered(line[: max(begin - 1, 0)], used)
    return 0 if begin and is_prose_too and ":=" not in line[:begin] else begin


def _is_closed(text: Sequence[Token]) -> bool:
    depth = 0
    for token in text:
        depth += (token.type in OPENING) - (token.type in CLOSING)
        if depth < 0:
            return False
    return not depth


def _space(text: Sequence[Token], index: int) -> int:
    return (text[index + 1].column or 0) - (text[index].end_column or 0)
