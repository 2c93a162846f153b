"""Fractions in front of single factors, as they are before products: ``3/2*M`` for ``3*M/2``."""

from __future__ import annotations

import re

from .printed_sum import factors_of, sum_of, terms_of


def with_leading_fractions(text: str) -> str:
    r"""Return a printed sum in which fractions lead their terms, in brackets too; halves stay under their bars.

    >>> with_leading_fractions("(3*M/2 + 7*m/5)*x'' - m*g/2 + a/2")
    "(3/2*M + 7/5*m)*x'' - m*g/2 + a/2"
    >>> with_leading_fractions(r"\left(\frac{3 M}{2} + m\right) \ddot{x}")
    '\\left(\\frac{3}{2} M + m\\right) \\ddot{x}'
    """
    terms = [*terms_of(text)]
    made = [(sign, _led(term)) for sign, term in terms]
    return text if made == terms else sum_of(made)


def _led(term: str) -> str:
    for start, end, _ in reversed([*factors_of(term)]):
        term = term[:start] + with_leading_fractions(term[start:end]) + term[end:]
    return _LATEX.sub(r"\\frac{\1}{\3} \2", _TEXT.sub(r"\1/\3*\2", term))


_TEXT = re.compile(r"^(\d+)\*(\w+'*(?:\*\*\d+)?)/(\d+)$")
_LATEX = re.compile(r"^\\frac\{(\d+) ((?:[^\s{}]|\{[^{}]*\})+)\}\{(\d+)\}$")
"""A fraction of one factor, other than a function."""
