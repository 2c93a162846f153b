"""Roots of polynomials in one unknown, as far as square roots give them."""

from __future__ import annotations

from collections.abc import Sequence

from symbody.symbolic._core import Expr
from symbody.symbolic.calculus.derivative import jacobian, subs
from symbody.symbolic.expression.functions import sqrt
from symbody.symbolic.expression.leaves import number

__all__ = ["coefficients", "polynomial_roots"]

_HIGHEST = 8
"""The highest degree that is looked for."""


def coefficients(expression: Expr, x: Expr) -> list[Expr] | None:
    """Return the coefficients of a polynomial, that of ``x**0`` first; None for what is no polynomial.

    >>> from symbody.symbolic import symbols
    >>> x, a = symbols("x a")
    >>> coefficients((x + a) ** 2, x)
    [a**2, 2*a, 1]
    """
    found: list[Expr] = []
    rest, factorial = expression, 1
    for k in range(_HIGHEST + 1):
        if not _depends(rest, x):
            found.append(rest / factorial)
            return found
        try:
            found.append(subs(rest, {x: number(0)}) / factorial)
        except ArithmeticError:
            return None
        rest = jacobian(rest, x)[0, 0]
        factorial *= k + 1
    return None


def _depends(e: Expr, x: Expr) -> bool:
    return x in e.free_symbols and not jacobian(e, x)[0, 0].is_zero


def polynomial_roots(of: Sequence[Expr]) -> list[Expr] | None:
    """Return the roots of a polynomial by its coefficients, that of ``x**0`` first; None if square roots don't do.

    >>> from symbody.symbolic import number, symbols
    >>> b, c = symbols("b c")
    >>> polynomial_roots([c, b, number(1)])
    [(sqrt(b**2 - 4*c) - b)/2, -(b + sqrt(b**2 - 4*c))/2]
    """
    known = list(of)
    while known and known[-1].is_zero:
        known.pop()
    null = 0
    while known and known[0].is_zero:
        known.pop(0)
        null += 1
    zero = [number(0)] if null else []
    degree = len(known) - 1
    if degree < 1:
        return zero
    if degree == 1:
        return [*zero, -known[0] / known[1]]
    if degree == 2:
        return zero + _quadratic(*known)
    if degree % 2 == 0 and all(each.is_zero for each in known[1::2]):
        squares = polynomial_roots(known[::2])
        return None if squares is None else zero + [root for s in squares for root in (sqrt(s), -sqrt(s))]
    return None


def _quadratic(c: Expr, b: Expr, a: Expr) -> list[Expr]:
    if b.is_zero:
        root = sqrt(-c / a)
        return [root] if root.is_zero else [root, -root]
    discriminant = b**2 - 4 * a * c
    if discriminant.is_zero:
        return [-b / (2 * a)]
    root = sqrt(discriminant)
    return [(root - b) / (2 * a), -(root + b) / (2 * a)]
