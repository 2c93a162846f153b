"""Entries of a mass matrix that are too long to be read, which is found without expanding them."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import accumulate

from symbody.symbolic import Expr, free_symbols, substitute
from symbody.symbolic.calculus.terms import number_of_terms

_TERMS, _OF_EACH = 100, 8
"""The largest number of terms of all entries, and of one entry on average; a sum of parameters is one term."""


def are_long(entries: Sequence[Expr]) -> bool:
    """Return whether the entries have too many terms when they are expanded.

    An entry for absolute angles has one term, ``(m1 + m2)*l1*l2*cos(q1 - q2)``; one of a spatial arm has hundreds.

    >>> from symbody import cos, functions_of_time, symbols
    >>> q, a = functions_of_time("q1:9"), symbols("a1:9")
    >>> product = cos(q[0])
    >>> for angle, length in zip(q, a):
    ...     product *= length + cos(angle)
    >>> are_long([product]), are_long([sum(a) * cos(q[0])])
    (True, False)
    """
    present = [entry for entry in entries if not entry.is_zero]
    parameters = sorted((leaf for leaf in free_symbols(present) if leaf.kind == "symbol"), key=str)
    moving = substitute(present, {leaf: _FIRST + _STEP * k**2 for k, leaf in enumerate(parameters)})
    most = max(_TERMS, _OF_EACH * len(present))
    return any(total > most for total in accumulate(map(number_of_terms, moving)))


_FIRST, _STEP = 1009, 211
"""Numbers that replace the parameters; no sum or product of them is 0 or 1 by chance."""
