"""From tokens to statements: Lark's tables for the grammar, driven one statement at a time."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

from lark import Lark, Token
from lark import __version__ as version
from lark.lark import PostLex

from symbody.files.cache_folder import folder
from symbody.worksheet.reading.builder import Builder, Mistake, one_place
from symbody.worksheet.reading.tables import Reduction, Tables, tables_of
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

_END = "$END"
_NOWHERE = Place(1, 1, 1, 1)

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


@cache
def _tables() -> Tables:
    return tables_of(_parser(), Builder())


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
    reading, depth = _Reading(_tables()), 0
    for index in range(begin, len(tokens)):
        token = tokens[index]
        if not reading.goes_on(token.type):
            return Failure(index)
        reading.shift(token)
        if len(reading.states) > _DEEPEST:
            return Failure(index, place=one_place(token), message=_TOO_DEEP)
        depth += opened(tokens, index)
        if depth <= 0 and token.type in TERMINATORS and reading.can_end(token.type):
            reading.goes_on(_END)
            mistake = reading.mistake
            if mistake is not None:
                return Failure(index, place=mistake.place, message=str(mistake))
            return Parsed(reading.values[-1], index + 1)
    return Failure(len(tokens))


class _Reading:
    """The stacks of the parser: states, what the parts have become, and where they begin and end."""

    __slots__ = ("mistake", "places", "states", "tables", "values")

    def __init__(self, tables: Tables) -> None:
        self.tables = tables
        self.states = [tables.start]
        self.values: list[Any] = []
        self.places: list[Token | Place | None] = []  # None: of no text
        self.mistake: Mistake | None = None

    def goes_on(self, kind: str) -> bool:
        """Reduce what ends before a token of this kind; return whether it can follow."""
        tables, states = self.tables, self.states
        steps = tables.steps
        while True:
            step = steps[states[-1]].get(kind)
            if step.__class__ is int:
                return True
            if step is None:
                return kind == _END and states[-1] == tables.end
            if step.meaning is None:  # type: ignore[union-attr]
                states[-1] = tables.settled(states[-2], states[-1], kind)
            else:
                self._reduce(step)  # type: ignore[arg-type]

    def shift(self, token: Token) -> None:
        """Take the token that follows."""
        self.states.append(self.tables.steps[self.states[-1]][token.type])  # type: ignore[arg-type]
        self.values.append(token)
        self.places.append(token)

    def can_end(self, kind: str) -> bool:
        """Whether the terminator ends the statement: ``<a, b; c, d>`` has one between its rows."""
        return kind != "SEMICOLON" or _END in self.tables.steps[self.states[-1]]

    def _reduce(self, rule: Reduction) -> None:
        states, values, places = self.states, self.values, self.places
        size = rule.size
        parts, place = [], None
        if size:
            parts, place = values[-size:], _joined(places[-size:])
            del states[-size:], values[-size:], places[-size:]
        values.append(self._meaning(rule, place or _NOWHERE, parts))
        places.append(place)
        states.append(self.tables.steps[states[-1]][rule.origin])  # type: ignore[arg-type]

    def _meaning(self, rule: Reduction, place: Place, parts: list[Any]) -> object:
        """Return what a rule means; behind the first mistake, only whether there is a statement matters."""
        if self.mistake is None:
            assert rule.meaning is not None
            try:
                return rule.meaning(place, rule.parts(parts))
            except Mistake as mistake:
                self.mistake = mistake
        return None


def _joined(places: list[Token | Place | None]) -> Place | None:
    """Return the place of parts that follow one another."""
    first, last = places[0], places[-1]
    if first is None or last is None:
        known = [place for place in places if place is not None]
        if not known:
            return None
        first, last = known[0], known[-1]
    return Place(first.line, first.column, last.end_line, last.end_column)  # type: ignore[arg-type]


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
