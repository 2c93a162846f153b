"""Triples: the three components of points, vectors and twists, in any frame."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TypeAlias

from symbody.symbolic import Expr, ExprLike, number

Scalar: TypeAlias = ExprLike
"""An expression, or a number that a user writes in its place."""

Triple: TypeAlias = tuple[Expr, Expr, Expr]
"""Components along x, y and z."""

Rate: TypeAlias = Callable[[Sequence[Expr]], tuple[Expr, ...]]
"""A derivative of expressions: by time, or by a coordinate."""

NULL: Triple = (number(0), number(0), number(0))


def expression(value: Scalar) -> Expr:
    """Return the expression of a number, and an expression as it is."""
    return value if isinstance(value, Expr) else number(value)


def triple(x: Scalar, y: Scalar, z: Scalar) -> Triple:
    """Return three expressions, of expressions or numbers."""
    return expression(x), expression(y), expression(z)


def is_null(components: Triple) -> bool:
    """Return whether all three components are zero."""
    x, y, z = components  # without a loop: the recursions ask for it at every step
    return x.is_zero and y.is_zero and z.is_zero


def rates(components: Triple, rate: Rate) -> Triple:
    """Return the derivatives of three components."""
    x, y, z = rate(components)
    return x, y, z
