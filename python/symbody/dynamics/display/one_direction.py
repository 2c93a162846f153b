"""Differences with waves, and those of products of parameters, have the direction in which they occur first."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from .printed_sum import Term, brackets_in, opposite, terms_of, with_signs

_WAVE, _BARE = re.compile(r"\b(?:sin|cos)\b"), re.compile(r"\\?(?:sin|cos)\([^()]*\)")
_PRODUCT = re.compile(r"[* ^]")


def in_one_direction(texts: Sequence[str], moving: Sequence[str] = ()) -> list[str]:
    """Return printed sums in which no difference is the opposite of an earlier one.

    So are brackets with sines or cosines, and brackets of parameters with products, as moments of masses; differences
    of single parameters have the direction of the model. Deflections such as ``sin(y) - sin(x)`` begin with the
    coordinate of their equation.

    Args:
        texts: the sums.
        moving: the printed functions of time.

    >>> in_one_direction(["a*(b*cos(x) - c)", "d*(c - b*cos(x))"], ["x"])
    ['a*(b*cos(x) - c)', '-d*(b*cos(x) - c)']
    >>> in_one_direction(["(J + 2*a*(c*M - b*m))*x", "a*(b*m - c*M)*y", "k*(a*x - y)", "k*(y - a*x)"], ["x", "y"])
    ['(J + 2*a*(c*M - b*m))*x', '-a*(c*M - b*m)*y', 'k*(a*x - y)', 'k*(y - a*x)']
    """
    moves = re.compile("|".join(rf"(?<![\w\\]){re.escape(name)}(?![A-Za-z0-9_])" for name in moving) or "$^")
    known, own = dict[frozenset[Term], str](), dict[str, str]()
    for text in texts:
        waves = (inner for inner in brackets_in(text) if _WAVE.search(inner))
        parameters = (
            inner for inner in _all_brackets_in(text) if not (_WAVE.search(inner) or moves.search(inner))
        )
        for inner in (*waves, *parameters):
            terms = [*terms_of(inner)]
            if _is_directed(terms):
                earlier = known.get(frozenset((opposite(sign), term) for sign, term in terms))
                if earlier is None:
                    known.setdefault(frozenset(terms), inner)
                else:
                    own[inner] = earlier
    return [with_signs(text, own) for text in texts] if own else [*texts]


def _is_directed(terms: Sequence[Term]) -> bool:
    """Return whether a sum is a difference that has no rule of its own, as those of single names or waves have."""
    has_products = any(_PRODUCT.search(term) and not _BARE.fullmatch(term) for _, term in terms)
    has_waves = any(_WAVE.search(term) for _, term in terms)
    is_bare = all(_BARE.fullmatch(term) for _, term in terms)
    return len({sign for sign, _ in terms}) > 1 and not is_bare and (has_waves or has_products)


def _all_brackets_in(text: str) -> Iterator[str]:
    """Yield the sums in brackets that are factors, and those within them, in their order."""
    for inner in brackets_in(text):
        yield inner
        yield from _all_brackets_in(inner)
