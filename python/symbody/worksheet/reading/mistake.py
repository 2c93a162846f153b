"""What a syntax error says: where it is, what was found there, what was expected, and often the way out."""

from __future__ import annotations

from collections.abc import Sequence

from lark import Token

from symbody.worksheet.reading.builder import one_place
from symbody.worksheet.reading.parse import Failure, accepted
from symbody.worksheet.sheet.source import Cell, SyntaxMistake
from symbody.worksheet.sheet.syntax import Place

__all__ = ["located", "mistake", "unclosed_vector", "unread"]

#: What can follow, in the order in which messages list it; an operand or an operator is told by one token of each.
_WORDS = {
    "NAME": "an expression",
    "TIMES": "an operator",
    "COMMA": "','",
    "RPAR": "')'",
    "RSQB": "']'",
    "RBRACE": "'}'",
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
}


def mistake(cell: Cell, tokens: Sequence[Token], begin: int, failure: Failure) -> SyntaxMistake:
    """Return the mistake of the statement at ``begin``, which can't be read."""
    if failure.place is not None:
        return _told(cell, failure.place, failure.message)
    read = tokens[begin : failure.index]
    expected = _expected(accepted(read))
    if failure.index >= len(tokens) or not tokens[failure.index]:
        place = one_place(tokens[failure.index - 1])
        end = Place(place.end_line, place.end_column, place.end_line, place.end_column + 1)
        message = located(cell, end, f"the statement is not complete, expected {expected}")
        return SyntaxMistake(end, message, is_open=True)
    token = tokens[failure.index]
    found = repr(str(token))
    return _told(cell, one_place(token), f"found {found}, expected {expected}{_hint(read, token)}")


def unclosed_vector(cell: Cell, tokens: Sequence[Token], index: int) -> SyntaxMistake:
    """Return the mistake of ``<a, b;``: the semicolon at the end of the line is no end of a row."""
    return _told(cell, one_place(tokens[index]), "found ';' at the end of the line, expected '>'")


def unread(cell: Cell, tokens: Sequence[Token], begin: int) -> SyntaxMistake:
    """Return the mistake of a statement after too many mistakes: the rest of the cell isn't read."""
    message = (
        "there are too many mistakes before this statement: neither it nor the rest of this cell is read"
    )
    return _told(cell, one_place(tokens[begin]), message)


def _hint(read: Sequence[Token], token: Token) -> str:
    """Return the way out of a typical mistake."""
    for word in (*(str(one) for one in read), str(token)):
        if word in _UNSUPPORTED:
            return f"; {_UNSUPPORTED[word]}"
    operands = {"NAME", "BACKQUOTED", "INTEGER", "DECIMAL", "STRING", "LPAR"}
    if read and token.type in operands and read[-1].type in operands | {"RPAR", "RSQB"}:
        return "; a product is written with *, and a remark begins with #"
    if str(token) == "!":
        return "; commands of the system are not run"
    return ""


def _expected(kinds: frozenset[str]) -> str:
    # A new statement can begin with many words; an expression is enough to say so.
    hidden = {"THEN", "DO", "SEMICOLON"} if "NAME" in kinds else set()
    hidden |= {"END"} if kinds & {"OD", "FI"} else set()
    words = [word for kind, word in _WORDS.items() if kind in kinds - hidden]
    if len(words) > 1:
        return f"{', '.join(words[:-1])} or {words[-1]}"
    return words[0] if words else "a statement"


def _told(cell: Cell, place: Place, message: str) -> SyntaxMistake:
    return SyntaxMistake(place, located(cell, place, message))


def located(cell: Cell, place: Place, message: str) -> str:
    """Return a message with its line and column, and below it the line with a caret under the place."""
    shown = ""
    for line in cell.input:
        if line.line == place.line:
            caret = " " * min(max(0, place.column - line.column), len(line.text))
            text = line.text.rstrip().replace("\t", " ")
            begin = max(0, len(caret) - _BEFORE)  # of a long line, what is around the place
            shown = f"\n  {text[begin : begin + _WIDTH]}\n  {caret[begin:]}^"
    return f"line {place.line}, column {place.column}: {message}{shown}"
