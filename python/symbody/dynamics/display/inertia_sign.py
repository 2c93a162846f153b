"""The sign of inertia: an acceleration in its own equation has a positive coefficient, ``(J - m*e**2)*q''``.

The printer gives a sum in brackets the sign with which it has fewer minus signs. The kinetic energy has a sign of its
own, which a hole, a body of negative mass, does not change.
"""

from __future__ import annotations

import re

from .printed_sum import Term, factors_of, opposite, sum_of, terms_of


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
    terms = [*terms_of(text)]
    if not acceleration and len(terms) > 1:
        return text
    factor_of = re.compile(rf".*(?:^|[* ]){re.escape(acceleration)}$" if acceleration else "", re.DOTALL)
    made = [_positive(each, least) if factor_of.match(each[1]) else each for each in terms]
    return text if made == terms else sum_of(made)


def _positive(term: Term, least: int) -> Term:
    """Return a term with the sign inside its first brackets that can take it."""
    sign, text = term
    if sign == "+":
        return term
    for start, end, exponent in factors_of(text):
        others = [(opposite(each), part) for each, part in terms_of(text[start:end])]
        first = next((place for place, (each, _) in enumerate(others) if each == "+"), None)
        if exponent == 1 and first is not None and len(others) >= least:
            turned = sum_of([others[first], *others[:first], *others[first + 1 :]])
            return "+", text[:start] + turned + text[end:]
    return term
