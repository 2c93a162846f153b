"""Differences with sines and cosines have one direction on a page, that in which they occur first."""

from __future__ import annotations

import re
from collections.abc import Sequence

from .printed_sum import Term, brackets_in, opposite, terms_of, with_signs

_WAVE, _BARE = re.compile(r"\b(?:sin|cos)\b"), re.compile(r"\\?(?:sin|cos)\([^()]*\)")


def in_one_direction(texts: Sequence[str]) -> list[str]:
    """Return printed sums in which no bracket with sines or cosines is the opposite of an earlier one.

    Deflections such as ``sin(y) - sin(x)`` begin with the coordinate of their equation.

    >>> in_one_direction(["a*(b*cos(x) - c)", "d*(c - b*cos(x))"])
    ['a*(b*cos(x) - c)', '-d*(b*cos(x) - c)']
    """
    known, own = dict[frozenset[Term], str](), dict[str, str]()
    for inner in (inner for text in texts for inner in brackets_in(text)):
        terms = [*terms_of(inner)]
        is_mixed = len({sign for sign, _ in terms}) > 1 and not all(
            _BARE.fullmatch(term) for _, term in terms
        )
        if is_mixed and _WAVE.search(inner):
            earlier = known.get(frozenset((opposite(sign), term) for sign, term in terms))
            if earlier is None:
                known.setdefault(frozenset(terms), inner)
            else:
                own[inner] = earlier
    return [with_signs(text, own) for text in texts] if own else [*texts]
