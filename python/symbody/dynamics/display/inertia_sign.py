"""The sign of inertia: an acceleration in its own equation has a positive coefficient, ``(J - m*e**2)*q''``.

The printer gives a sum in brackets the sign with which it has fewer minus signs. The kinetic energy has a sign of its
own, which a hole, a body of negative mass, does not change.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import accumulate

_OPENING = re.compile(r"(?:^|(?<=[* ]))(?:\\left)?\(")
_RIGHT = r"\right"
_ODD = re.compile(r"$|\*(?!\*)|/| ")
"""What stands behind the brackets of a factor; no power."""
Term = tuple[str, str]
"""A sign and a printed term."""


def with_positive_inertia(text: str, acceleration: str = "", *, least: int = 2) -> str:
    r"""Return a printed sum in which the factor of an acceleration begins with plus, if it has terms of both signs.

    Args:
        text: the sum, as text or in LaTeX.
        acceleration: the printed acceleration; without it, the sum is the factor itself.
        least: the terms that a sum in brackets has at least.

    >>> with_positive_inertia("-(m*a**2 - J + m*e**2)*q'' - k*(b - a)", "q''")
    "(J - m*a**2 - m*e**2)*q'' - k*(b - a)"
    >>> with_positive_inertia(r"-r^{2} \, \left(m - M + a\right)")
    'r^{2} \\, \\left(M - m - a\\right)'
    """
    terms = [*_terms(text)]
    if not acceleration and len(terms) > 1:
        return text
    factor_of = re.compile(rf".*(?:^|[* ]){re.escape(acceleration)}$" if acceleration else "", re.DOTALL)
    made = [_positive(each, least) if factor_of.match(each[1]) else each for each in terms]
    return text if made == terms else _sum(made)


def _positive(term: Term, least: int) -> Term:
    """Return a term with the sign inside its first brackets that can take it."""
    sign, text = term
    if sign == "+":
        return term
    for start, end, inner in _factors(text):
        opposite = [("+-"[each == "+"], part) for each, part in _terms(inner)]
        first = next((place for place, (each, _) in enumerate(opposite) if each == "+"), None)
        if first is not None and len(opposite) >= least:
            turned = _sum([opposite[first], *opposite[:first], *opposite[first + 1 :]])
            return "+", text[:start] + turned + text[end:]
    return term


def _factors(text: str) -> Iterator[tuple[int, int, str]]:
    """Yield where the sums in brackets that are factors of a product begin and end, and these sums."""
    depths = [*accumulate(map(_step, text))]
    for opening in _OPENING.finditer(text):
        start = opening.end()
        if depths[start - 1] == 1:
            end = depths.index(0, start)
            if _ODD.match(text, end + 1):
                end -= len(_RIGHT) * text.endswith(_RIGHT, start, end)
                yield start, end, text[start:end]


def _terms(text: str) -> Iterator[Term]:
    """Yield the terms of a printed sum."""
    sign, start, depth = "+", 0, 0
    if text.startswith("-"):
        sign, start = "-", 1
    for place, character in enumerate(text):
        depth += _step(character)
        if depth == 0 and text[place : place + 3] in {" + ", " - "}:
            yield sign, text[start:place]
            sign, start = text[place + 1], place + 3
    yield sign, text[start:]


def _sum(terms: list[Term]) -> str:
    text = "".join(f" {sign} {term}" for sign, term in terms)
    return text[3:] if text.startswith(" + ") else f"-{text[3:]}"


def _step(character: str) -> int:
    return (character in "([{") - (character in ")]}")
