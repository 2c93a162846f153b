"""Lists of names in a string: separated by spaces or commas, with ranges as in SymPy."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from itertools import product
from string import ascii_letters

from symbody.errors import ExpressionError

__all__ = ["is_list_of_names", "names_in"]

_BARE = r"(?:[0-9]*:[0-9]+|[A-Za-z]?:[A-Za-z])"
_RANGE = re.compile(rf"(\({_BARE}\)|{_BARE})")
_MOST = 100_000
"""The most names in one range; more are a typing error."""


def is_list_of_names(text: str) -> bool:
    """Whether a string denotes a list of names: it has a comma, a range, or several words."""
    if text.isidentifier():
        return False
    stripped = text.strip()
    return any(sign in stripped for sign in ",:") or len(stripped.split()) > 1


def names_in(text: str) -> list[str]:
    """Return the names in a string; ``x0:3`` is a range of numbers, ``a:d`` a range of letters.

    Raises:
        ExpressionError: a comma without a name, or an empty or incomplete range.

    >>> names_in("m, g l1:3"), names_in("x:2(a:c)")
    (['m', 'g', 'l1', 'l2'], ['x0a', 'x0b', 'x0c', 'x1a', 'x1b', 'x1c'])
    """
    if text.isidentifier():  # by far the most frequent text, and the rules of lists take long
        return [text]
    parts = text.strip().removesuffix(",").split(",")
    if any(not part.strip() for part in parts):
        problem = "a name is missing between two commas" if text.strip(" ,") else "no name"
        raise ExpressionError(f"{problem} in {text!r}; expected names separated by blanks, such as 'm g l1'")
    return [name for part in parts for word in part.split() for name in _expanded(word)]


def _expanded(word: str) -> Iterator[str]:
    """Return the names of a word: all combinations of the members of its ranges; the last range varies fastest."""
    pieces = _RANGE.split(word)
    if any(":" in literal for literal in pieces[::2]):
        raise ExpressionError(f"{word!r} has a range without an end; expected one such as 'x0:3' or 'a:d'")
    members = [_members(piece.strip("()"), word) if k % 2 else [piece] for k, piece in enumerate(pieces)]
    _check_size(members, word)
    return map("".join, product(*members))


def _members(piece: str, word: str) -> Sequence[str]:
    first, last = piece.split(":")
    found: Sequence[str]
    if last.isdigit():
        numbers = range(int(first or 0), int(last))
        _check_size([numbers], word)
        found = [str(k) for k in numbers]
    else:
        begin, end = ascii_letters.index(first or "a"), ascii_letters.index(last)
        found = ascii_letters[begin : end + 1]
    if not found:
        raise ExpressionError(
            f"the range {piece} in {word!r} is empty; expected one such as 'x0:3', which is x0 x1 x2, or 'a:d'"
        )
    return found


def _check_size(members: Iterable[Sequence[object]], word: str) -> None:
    count = 1
    for each in members:
        count *= len(each)
    if count > _MOST:
        raise ExpressionError(f"{word!r} has {count} names; expected at most {_MOST} in one range")
