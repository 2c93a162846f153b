"""What a syntax error says: where it is, what was found there, what was expected, and often the way out."""

from __future__ import annotations

from collections.abc import Sequence

from lark import Token

from symbody.worksheet.reading.builder import one_place
from symbody.worksheet.reading.parse import Failure
from symbody.worksheet.source import Cell, SyntaxMistake
from symbody.worksheet.syntax import Place

__all__ = ["located", "mistake"]

#: What can follow, in the order in which messages list it; an operand or an operator is told by one token of each.
_WORDS = {
    "NAME": "an expression",
    "TIMES": "an operator",
    "COMMA": "','",
    "RPAR": "')'",
    "RSQB": "']'",
    "RBRACE": "'}'",
    "GREATER": "'>'",
    "THEN": "'then'",
    "DO": "'do'",
    "OD": "'end do'",
    "FI": "'end if'",
    "END": "'end'",
    "SEMICOLON": "';' or ':'",
}

#: Of a long line, how many characters are shown, and how many of them before the place.
_WIDTH, _BEFORE = 100, 60

#: Words that open a construct which worksheets of MBSymba don't need.
_UNSUPPORTED = {
    "module": "modules are not supported: write procedures, and a table for what they share",
    "use": "'use' is not supported: write with(..), or package[command](..)",
}


def mistake(cell: Cell, tokens: Sequence[Token], failure: Failure) -> SyntaxMistake:
    """Return the mistake of a statement that can't be read."""
    if failure.place is not None:
        return _told(cell, failure.place, failure.message)
    expected = _expected(failure.expected)
    if failure.index >= len(tokens):
        place = one_place(tokens[-1])
        end = Place(place.end_line, place.end_column, place.end_line, place.end_column + 1)
        return _told(cell, end, f"the statement is not complete, expected {expected}")
    token = tokens[failure.index]
    found = repr(str(token))
    hint = _hint(tokens, failure.index)
    return _told(cell, one_place(token), f"found {found}, expected {expected}{hint}")


def _hint(tokens: Sequence[Token], index: int) -> str:
    """Return the way out of a typical mistake."""
    token, before = tokens[index], tokens[index - 1] if index else None
    if before is not None and before.type == "NAME" and str(before) in _UNSUPPORTED:
        return f"; {_UNSUPPORTED[str(before)]}"
    if str(token) in _UNSUPPORTED:
        return f"; {_UNSUPPORTED[str(token)]}"
    operands = {"NAME", "BACKQUOTED", "INTEGER", "DECIMAL", "STRING", "LPAR"}
    if before is not None and token.type in operands and before.type in operands | {"RPAR", "RSQB"}:
        return "; a product is written with *, and a remark begins with #"
    if str(token) == "!":
        return "; commands of the system are not run"
    return ""


def _expected(kinds: frozenset[str]) -> str:
    words = [word for kind, word in _WORDS.items() if kind in kinds]
    if (
        "TIMES" in kinds
    ):  # behind an operand most words can follow: the operator and the closing signs are enough
        words = [word for word in words if word not in {"'then'", "'do'", "'end do'", "'end if'", "'end'"}]
    return (
        " or ".join([", ".join(words[:-1]), words[-1]]) if len(words) > 1 else (words or ["a statement"])[0]
    )


def _told(cell: Cell, place: Place, message: str) -> SyntaxMistake:
    return SyntaxMistake(place, located(cell, place, message))


def located(cell: Cell, place: Place, message: str) -> str:
    """Return a message with its line and column, and below it the line with a caret under the place."""
    shown = ""
    for line in cell.input:
        if line.line == place.line:
            caret = " " * min(max(0, place.column - line.column), len(line.text))
            text = line.text.rstrip().replace("\t", " ")
            begin = max(0, len(caret) - _BEFORE)    # of a long line, what is around the place
            shown = f"\n  {text[begin : begin + _WIDTH]}\n  {caret[begin:]}^"
    return f"line {place.line}, column {place.column}: {message}{shown}"
