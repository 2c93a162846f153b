"""From tokens to statements: Lark's tables for the grammar, driven one statement at a time."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from lark import Lark, Token, UnexpectedToken
from lark import __version__ as version
from lark.exceptions import VisitError
from lark.lark import PostLex
from lark.parsers.lalr_interactive_parser import InteractiveParser

from symbody.files.cache_folder import folder
from symbody.worksheet.reading.builder import Builder, Mistake, one_place
from symbody.worksheet.sheet.source import Line
from symbody.worksheet.sheet.syntax import Place, Statement

__all__ = [
    "TERMINATORS",
    "Failure",
    "Parsed",
    "accepted",
    "is_statement",
    "next_statement",
    "opened",
    "terminator_after",
    "tokens_of",
]

#: Of statements with more tokens, what can follow is not worked out exactly: this copies what has been read.
_LONG = 300

#: How many constructs may be open at once: brackets, signs before signs, and the like.
_DEEPEST = 1000
_TOO_DEEP = f"more than {_DEEPEST} signs are open here; assign inner parts to names"

TERMINATORS = frozenset({"SEMICOLON", "COLON"})

_OPEN = frozenset({"DO", "IF", "PROC", "TRY"})
_CLOSE = frozenset({"OD", "FI", "END"})


@dataclass(frozen=True, slots=True)
class Parsed:
    """A statement, and the number of tokens up to its end."""

    statement: Statement
    end: int


@dataclass(frozen=True, slots=True)
class Failure:
    """Why tokens are no statement.

    Attributes:
        index: the token that can't follow; the number of tokens where they end too early.
        place, message: of a statement that has the form of the grammar, but no meaning.
    """

    index: int
    place: Place | None = None
    message: str = ""


class _EveryToken(PostLex):
    """Keeps the token of characters that mean nothing, which no rule uses."""

    always_accept: Iterable[str] = ("UNKNOWN",)

    def process(self, stream: Iterator[Token]) -> Iterator[Token]:
        return stream


@cache
def _parser() -> Lark:
    grammar = Path(__file__).with_name("maple.lark").read_text(encoding="utf-8")
    kept = folder()  # Lark checks that a file is of this grammar, and of its own version
    return Lark(
        grammar,
        parser="lalr",
        lexer="basic",
        propagate_positions=True,
        maybe_placeholders=True,
        postlex=_EveryToken(),
        cache=False if kept is None else str(kept / f"maple-{version}.lark"),
    )


def tokens_of(line: Line) -> list[Token]:
    """Return the tokens of a line, with their places in the file."""
    reading = _parser().parse_interactive(line.text)
    tokens = list(reading.lexer_thread.lex(reading.parser_state))  # type: ignore[no-untyped-call]
    for token in tokens:
        width = (token.end_column or 1) - (token.column or 1)
        token.line = token.end_line = line.line
        token.column = (token.column or 1) + line.column - 1
        token.end_column = token.column + width
    return tokens


def next_statement(tokens: Sequence[Token], begin: int = 0) -> Parsed | Failure:
    """Return the statement that begins at a token, with its terminator, or why there is none."""
    parser = _parser().parse_interactive("")
    index, depth = begin, 0
    try:
        for index in range(begin, len(tokens)):
            parser.feed_token(tokens[index])
            if len(parser.parser_state.state_stack) > _DEEPEST:
                return Failure(index, place=one_place(tokens[index]), message=_TOO_DEEP)
            depth += opened(tokens, index)
            if depth <= 0 and tokens[index].type in TERMINATORS and _ends(parser, tokens[index]):
                tree = parser.feed_token(Token.new_borrow_pos("$END", "", tokens[index]))
                return Parsed(Builder().transform(tree), index + 1)
    except UnexpectedToken:
        return Failure(index)
    except VisitError as error:
        return _failure(index, error.orig_exc)
    return Failure(len(tokens))


def _ends(parser: InteractiveParser, token: Token) -> bool:
    """Whether a terminator ends the statement: ``<a, b; c, d>`` has one between its rows."""
    return token.type != "SEMICOLON" or "$END" in parser.choices()  # type: ignore[no-untyped-call]


def accepted(tokens: Sequence[Token]) -> frozenset[str]:
    """Return the kinds of tokens that can follow the beginning of a statement; of a long one, those that may."""
    parser = _parser().parse_interactive("")
    for token in tokens:
        parser.feed_token(token)
    if len(tokens) > _LONG:
        return frozenset(parser.choices())  # type: ignore[no-untyped-call]
    return frozenset(parser.accepts())  # type: ignore[no-untyped-call]


def is_statement(tokens: Sequence[Token]) -> bool:
    """Whether tokens without a terminator are a whole statement."""
    return bool(tokens) and isinstance(next_statement([*tokens, terminator_after(tokens[-1])]), Parsed)


def opened(tokens: Sequence[Token], index: int) -> int:
    """Return 1 for a word that opens a list of statements, -1 for one that closes it; words of Maple are reserved."""
    kind = tokens[index].type
    if kind in _CLOSE:
        return -1
    if kind == "NAME" and tokens[index] == "module":  # which isn't read, but has an end
        kind = "PROC" if index + 1 < len(tokens) and tokens[index + 1].type == "LPAR" else kind
    return int(kind in _OPEN and not (index and tokens[index - 1].type == "END"))


def _failure(index: int, error: Exception) -> Failure:
    if isinstance(error, Mistake):
        return Failure(index, place=error.place, message=str(error))
    raise error


def terminator_after(token: Token) -> Token:
    """Return the terminator that the end of a cell stands for: one without text."""
    place = one_place(token)
    return Token(
        "SEMICOLON",
        "",
        line=place.end_line,
        column=place.end_column,
        end_line=place.end_line,
        end_column=place.end_column,
    )
