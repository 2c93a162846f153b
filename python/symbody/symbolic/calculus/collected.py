"""Collected polynomials whose coefficients hold only symbols on which they depend."""

from __future__ import annotations

from collections.abc import Sequence

from symbody.symbolic import _core
from symbody.symbolic._core import Expr

from .idle import without_idle_symbols


def with_needed_coefficients(polynomial: Expr, variables: Sequence[Expr]) -> Expr:
    """Return a collected polynomial whose coefficients hold only symbols on which they depend.

    >>> from symbody import cos, sin, symbols
    >>> a, b, q, x = symbols("a b q x")
    >>> with_needed_coefficients((a + b * sin(q) ** 2 + b * cos(q) ** 2) * x, [x])
    x*(a + b)
    """
    terms = polynomial.args if polynomial.kind == "sum" else (polynomial,)
    constant = [term for term in terms if not any(term.has(variable) for variable in variables)]
    others = [_needed(term, len(variables)) for term in terms if term not in constant]
    (rest,) = without_idle_symbols([_core.sum_of(constant)])
    found = _core.sum_of([*others, rest])
    return polynomial if found.same_form(polynomial) else found


def _needed(node: Expr, depth: int) -> Expr:
    """Return a sum or a product; the sums in its products are polynomials of fewer variables, or coefficients."""
    if node.kind == "sum":
        return _core.sum_of([_needed(term, depth) for term in node.args])
    if node.kind == "product":
        return _core.product_of([_factor(factor, depth) for factor in node.args])
    return node


def _factor(factor: Expr, depth: int) -> Expr:
    inner = _needed(factor, depth - 1) if depth > 1 else factor
    return without_idle_symbols([inner])[0] if factor.kind == "sum" else inner
