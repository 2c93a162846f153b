"""Roots of cubic equations by Cardano's formula [van der Waerden 1991, sec. 8.8].

x^3 + p x + q = 0 has the roots u + v with u^3 = -q/2 + sqrt(D), u v = -p/3, D = (q/2)^2 + (p/3)^3. Where the
coefficients are numbers and D < 0, all three are real: 2 sqrt(-p/3) cos(phi + 2 pi k/3).
"""

from __future__ import annotations

from collections.abc import Sequence

from symbody.symbolic import Expr, acos, cos, number, pi, sqrt
from symbody.worksheet.values.complex_number import I
from symbody.worksheet.values.numeric import as_float

__all__ = ["cubic_roots"]

_THIRD = number(1) / 3


def cubic_roots(known: Sequence[Expr]) -> list[Expr]:
    """Return the three roots of a polynomial of degree three by its coefficients, the constant first."""
    c, b, a = (each / known[3] for each in known[:3])
    p, q = b - a**2 / 3, 2 * a**3 / 27 - a * b / 3 + c
    discriminant = q**2 / 4 + p**3 / 27
    size = as_float(discriminant)
    roots = _real(p, q) if size is not None and size < 0 else _radicals(p, q, discriminant)
    return [root - a / 3 for root in roots]


def _real(p: Expr, q: Expr) -> list[Expr]:
    """Return three real roots; Cardano's formula would need roots of complex numbers."""
    length, angle = 2 * sqrt(-p / 3), acos(3 * q / (2 * p) * sqrt(-3 / p)) / 3
    return [length * cos(angle - 2 * pi * k / 3) for k in range(3)]


def _radicals(p: Expr, q: Expr, discriminant: Expr) -> list[Expr]:
    """Return one root that is real for real coefficients, and two that are conjugate."""
    half = as_float(q)
    if p.is_zero:
        u = _cube_root(-q)
        v = number(0)
    else:  # of the two signs of the square root, the one with which nothing cancels
        u = _cube_root(
            -q / 2 - sqrt(discriminant) if half is not None and half > 0 else sqrt(discriminant) - q / 2
        )
        v = -p / (3 * u)
    turned = I * sqrt(number(3)) / 2 * (u - v)
    return [u + v, -(u + v) / 2 + turned, -(u + v) / 2 - turned]


def _cube_root(value: Expr) -> Expr:
    size = as_float(value)
    return -((-value) ** _THIRD) if size is not None and size < 0 else value**_THIRD
