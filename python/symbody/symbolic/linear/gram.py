"""Scalar products of lists of expressions, and matrices of such products."""

from __future__ import annotations

from collections.abc import Sequence

from symbody.symbolic._core import Expr, number
from symbody.symbolic.expression.matrix import Matrix

__all__ = ["gram", "scalar_product"]


def scalar_product(a: Sequence[Expr], b: Sequence[Expr]) -> Expr:
    """Return the scalar product of two lists."""
    # Long lists are mostly zeros; multiplying them took a third of the derivation of a long chain of linkages.
    terms = (x * y for x, y in zip(a, b, strict=True) if not (x.is_zero or y.is_zero))
    return sum(terms, start=number(0))


def gram(lines: Sequence[Sequence[Expr]], images: Sequence[Sequence[Expr]]) -> Matrix:
    """Return ``L A L^T`` from the rows of L and their images under a symmetric A; each product is computed once."""
    count = len(lines)
    lower = [[scalar_product(lines[i], images[j]) for j in range(i + 1)] for i in range(count)]
    entries = [lower[max(i, j)][min(i, j)] for i in range(count) for j in range(count)]
    return Matrix.from_entries(count, count, entries)
