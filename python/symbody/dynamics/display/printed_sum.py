"""Printed sums taken apart: their terms, and the sums in brackets that are factors of a term."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from itertools import accumulate

_OPENING = re.compile(r"(?:^|(?<=[* ]))(?:\\left)?\(")
_RIGHT = r"\right"
_BEHIND = re.compile(r"(?:\*\*|\^\{)(?P<exponent>\d+)|$|\*(?!\*)|/| ")
"""What stands behind the brackets of a factor: a whole power, or no power."""
Term = tuple[str, str]
"""A sign and a printed term."""


def terms_of(text: str) -> Iterator[Term]:
    """Yield the terms of a printed sum.

    >>> [*terms_of("-(a - b)*x + c")]
    [('-', '(a - b)*x'), ('+', 'c')]
    """
    sign, start, depth = "+", 0, 0
    if text.startswith("-"):
        sign, start = "-", 1
    for place, character in enumerate(text):
        depth += _step(character)
        if depth == 0 and text[place : place + 3] in {" + ", " - "}:
            yield sign, text[start:place]
            sign, start = text[place + 1], place + 3
    yield sign, text[start:]


def factors_of(term: str) -> Iterator[tuple[int, int, int]]:
    """Yield where the sums in brackets that are factors of a product begin and end, and their exponents.

    >>> text = "a*(b - c)**3*(x + y)"
    >>> [(text[start:end], exponent) for start, end, exponent in factors_of(text)]
    [('b - c', 3), ('x + y', 1)]
    """
    depths = [*accumulate(map(_step, term))]
    for opening in _OPENING.finditer(term):
        start = opening.end()
        if depths[start - 1] == 1:
            end = depths.index(0, start)
            behind = _BEHIND.match(term, end + 1)
            if behind:
                end -= len(_RIGHT) * term.endswith(_RIGHT, start, end)
                yield start, end, int(behind["exponent"] or 1)


def sum_of(terms: Iterable[Term]) -> str:
    """Return the printed sum of terms.

    >>> sum_of([("-", "a"), ("+", "b")])
    '-a + b'
    """
    text = "".join(f" {sign} {term}" for sign, term in terms)
    return text[3:] if text.startswith(" + ") else f"-{text[3:]}"


def opposite(sign: str) -> str:
    """Return the other sign."""
    return "-" if sign == "+" else "+"


def opposite_of(text: str) -> str:
    """Return the printed opposite of a sum that begins with a minus sign; nothing for other texts.

    >>> opposite_of("-a*b - c"), opposite_of("a - b"), opposite_of("-a*b")
    ('a*b + c', '', '')
    """
    terms = [*terms_of(text)]
    is_negative = len(terms) > 1 and terms[0][0] == "-"
    return sum_of((opposite(sign), term) for sign, term in terms) if is_negative else ""


def brackets_in(text: str) -> Iterator[str]:
    """Yield the sums in brackets that are factors of the terms of a printed sum.

    >>> [*brackets_in("a*(b - c*(x + y)) - (x - y)**2")]
    ['b - c*(x + y)', 'x - y']
    """
    for _, term in terms_of(text):
        yield from (term[start:end] for start, end, _ in factors_of(term))


def with_signs(text: str, own: Mapping[str, str]) -> str:
    """Return a printed sum in which sums in brackets have signs of their own.

    Args:
        text: the sum.
        own: sums in brackets, and their opposites, which take their places.

    >>> with_signs("a - b*(y - x + c)", {"y - x + c": "x - y - c"})
    'a + b*(x - y - c)'
    """
    terms = [*terms_of(text)]
    made = [_with_sign(term, own) for term in terms]
    return text if made == terms else sum_of(made)


def _with_sign(term: Term, own: Mapping[str, str]) -> Term:
    sign, text = term
    for start, end, exponent in reversed([*factors_of(text)]):
        inner = text[start:end]
        if inner in own and exponent % 2:
            sign = opposite(sign)
        text = text[:start] + (own.get(inner) or with_signs(inner, own)) + text[end:]
    return sign, text


def _step(character: str) -> int:
    return (character in "([{") - (character in ")]}")
