"""Long formulas in lines: broken before signs, and inside a term with a deeper indentation.

A formula is given as tokens, so that text and LaTeX are broken alike. A term that fills more than a line begins on a
line of its own, and ends one: what begins in the middle of a line is never the outer term of what stands below it.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass
from typing import Literal, NamedTuple, TypeAlias

Role: TypeAlias = Literal["", "sign", "equals", "open", "factor", "argument", "kept", "close"]
"""What a token is: a sign between terms; the opening bracket of a sum, of one that is a factor after others, of the
arguments of a function, or of what is never broken; or a closing bracket."""


class Token(NamedTuple):
    """A piece of a formula that is not broken."""

    text: str
    width: int
    role: Role = ""


@dataclass(frozen=True)
class Row:
    """A line, and the levels by which it is indented."""

    indent: int
    tokens: tuple[Token, ...]

    @property
    def width(self) -> int:
        """The characters of the line without its indentation."""
        return _width(self.tokens)


_Piece: TypeAlias = tuple[Token, ...]
_OPENING: Collection[Role] = {"open", "factor", "argument", "kept"}
_SUMS: Collection[Role] = {"open", "factor"}
_LONG = 0.6
"""The part of a line from which on a bracket is broken before the product in which it stands is, and a part is long."""
_HALF, _INDENT = 0.3, 4
"""The least part of a line that each of two parts of a term fills, and the characters that the second is indented."""
_SHORT = 12
"""The characters of a side of an equation that never stands alone."""
_DEEPEST = 5
"""The levels of indentation at most."""


def rows(tokens: Sequence[Token], line: int, step: int) -> list[Row]:
    """Return a formula in lines that are no longer than a line, if that is possible.

    Args:
        tokens: the formula.
        line: the length of a line.
        step: the characters by which a level is indented.
    """
    return _Filling(line, step).rows(_with_short_sides(terms_of(tokens), line), 0, 0)


class _Filling(NamedTuple):
    """Pieces are put on lines as long as they fit."""

    line: int
    step: int

    def rows(self, pieces: Sequence[_Piece], first: int, further: int) -> list[Row]:
        """Return the lines of pieces.

        Args:
            pieces: terms of a sum, or parts of a term.
            first: the indentation of the first piece.
            further: that of the others.
        """
        made, is_open = list[Row](), False
        for place, piece in enumerate(pieces):
            if is_open and made[-1].width + _width(piece) <= self.room(made[-1].indent):
                made[-1] = Row(made[-1].indent, made[-1].tokens + piece)
                continue
            indent = further if place else first
            parts = [piece] if _width(piece) <= self.room(indent) else _parts(piece, self.room(indent))
            is_open = len(parts) == 1
            made += [Row(indent, piece)] if is_open else self.rows(parts, indent, min(indent + 1, _DEEPEST))
        return made

    def room(self, indent: int) -> int:
        return self.line - self.step * indent


def _with_short_sides(terms: list[_Piece], line: int) -> list[_Piece]:
    """Return terms with a short side of an equation beside the nearest term of the other one.

    A right side of several terms stands on one line, if it fits.
    """
    if len(terms) > 1 and terms[1][0].role == "equals" and _width(terms[0]) <= _SHORT:
        terms = [terms[0] + terms[1], *terms[2:]]
    if len(terms) > 1 and terms[-1][0].role == "equals":
        right = _width(terms[-1])
        if right <= _SHORT or right + _width(terms[-2]) <= line:
            return [*terms[:-2], terms[-2] + terms[-1]]
    place = next((k for k, term in enumerate(terms) if k and term[0].role == "equals"), len(terms))
    side = tuple(token for term in terms[place:] for token in term)
    return [*terms[:place], side] if side and _width(side) <= line - _INDENT else terms


def terms_of(tokens: Sequence[Token]) -> list[tuple[Token, ...]]:
    """Return the terms of a sum and of an equation, each with the sign before it."""
    level, places = 0, list[int]()
    for place, token in enumerate(tokens):
        if token.role in {"sign", "equals"} and not level and place:
            places.append(place)
        level += (token.role in _OPENING) - (token.role == "close")
    return _split(tuple(tokens), places)


def _parts(term: _Piece, room: int) -> list[_Piece]:
    """Return the parts of a term that is too long: it is broken in long sums and before short ones.

    Before that, two parts are tried of which the first isn't short: those before and after a factor or a division. If
    nothing else can be, short sums are broken, and at last the arguments of functions.
    """
    halves = _halves(term, room)
    if halves:
        return halves
    for kinds, long in ((_SUMS, _LONG * room), (_SUMS, 0), ({*_SUMS, "argument"}, 0)):
        places = [*_breaks(term, 0, len(term), kinds, long)]
        if places:
            return _split(term, places)
    return [term]


def _halves(term: _Piece, room: int) -> list[_Piece]:
    """Return a term in two parts, the first as long as possible: both fit, or the first fills most of a line."""
    level = 0
    found = list[list[_Piece]]()
    for place, token in enumerate(term):
        if place and not level and (token.role == "factor" or _divides(term, place)):
            found.append(_split(term, [place]))
        level += (token.role in _OPENING) - (token.role == "close")
    fitting = [each for each in found if all(_HALF * room <= _width(part) <= room - _INDENT for part in each)]
    return next(reversed(fitting or [each for each in found if _LONG * room <= _width(each[0]) <= room]), [])


def _divides(term: _Piece, place: int) -> bool:
    """Return whether a token is the division by a function, as by a root."""
    return term[place].text == "/" and any(token.role == "argument" for token in term[place + 1 : place + 3])


def _breaks(term: _Piece, start: int, end: int, kinds: Collection[str], long: float) -> Iterator[int]:
    """Yield the places where a part of a term is broken.

    Args:
        term: the term.
        start: the first token of the part.
        end: the token after the last one.
        kinds: the brackets that are broken.
        long: the characters from which on they are.
    """
    place, is_broken = start, False
    while place < end:
        role = term[place].role
        closing = _closing(term, place) if role in _OPENING else place
        if role in kinds:
            is_short = closing < len(term) and _width(term[place:closing]) <= long
            if role == "factor" and place > 0 and (is_short or is_broken):
                yield place
            if not is_short:
                signs = [*_signs(term, place + 1, closing)]
                yield from signs or _breaks(term, place + 1, min(closing, end), kinds, long)
                is_broken = True
        place = closing + 1


def _closing(term: _Piece, opening: int) -> int:
    """Return the place of the bracket that closes another one; the end if it stands on a further line."""
    level = 0
    for place in range(opening, len(term)):
        level += (term[place].role in _OPENING) - (term[place].role == "close")
        if not level:
            return place
    return len(term)


def _signs(term: _Piece, start: int, end: int) -> Iterator[int]:
    """Yield the signs between the terms of a sum in brackets."""
    level = 0
    for place in range(start, end):
        if term[place].role == "sign" and not level and place > start:
            yield place
        level += (term[place].role in _OPENING) - (term[place].role == "close")


def _split(tokens: _Piece, places: Sequence[int]) -> list[_Piece]:
    return [tokens[start:end] for start, end in zip([0, *places], [*places, len(tokens)], strict=True)]


def _width(tokens: Sequence[Token]) -> int:
    return sum(token.width for token in tokens)
