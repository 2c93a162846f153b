"""Expressions by their degree in the speeds."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from symbody.errors import SymbodyError
from symbody.multibody import Variables
from symbody.symbolic import Expr, Matrix, diff, jacobian, number, subs, substitute

Product = tuple[Expr, Expr]
"""A coefficient, and the product of speeds that it multiplies."""


@dataclass(frozen=True)
class Degrees:
    """A quadratic polynomial of the speeds.

    Attributes:
        constant: the terms without speeds.
        linear: the coefficients of single speeds.
        quadratic: the coefficients of products of two speeds.
    """

    constant: Expr
    linear: tuple[Product, ...]
    quadratic: tuple[Product, ...]

    @property
    def total(self) -> Expr:
        """The polynomial."""
        return sum((c * u for c, u in (*self.linear, *self.quadratic)), start=self.constant)

    def substituted(self, mapping: Mapping[Expr, Expr]) -> Degrees:
        """Return the polynomial with other leaves in its coefficients."""
        linear, quadratic = (
            tuple((substitute([value], mapping)[0], product) for value, product in products)
            for products in (self.linear, self.quadratic)
        )
        return Degrees(substitute([self.constant], mapping)[0], linear, quadratic)


def without(expression: Expr, symbols: Sequence[Expr]) -> Expr:
    """Return an expression with zeros in place of symbols; the expression itself if it isn't defined there."""
    try:
        return subs(expression, dict.fromkeys(symbols, 0)) if symbols else expression
    except SymbodyError:
        return expression


def is_defined_without(expression: Expr, symbols: Sequence[Expr]) -> bool:
    """Return whether an expression is defined with zeros in place of symbols."""
    try:
        subs(expression, dict.fromkeys(symbols, 0))
    except SymbodyError:
        return False
    return True


def part_of(expression: Expr, symbols: Sequence[Expr]) -> Expr:
    """Return the terms that vanish with symbols, in a form without the other terms where they are linear."""
    rest = expression - without(expression, symbols)
    linear = number(0)
    for symbol in symbols:
        linear += symbol * diff(expression, symbol)
    return linear if linear == rest else rest


def by_christoffel(
    inertia: Sequence[Expr], mass_matrix: Matrix, system: Variables, places: Sequence[int] | None = None
) -> list[Degrees | None]:
    """Return the forces of inertia that follow from the mass matrix alone, by Christoffel's symbols.

    Derivatives of short entries are short. None where the forces have other terms too, as on a moving support.

    Args:
        inertia: the forces of inertia.
        mass_matrix: M, n x n.
        system: the system to which the forces belong.
        places: the rows whose forces they are; by default all.
    """
    if system.has_quasi_velocities:
        return [None] * len(inertia)
    n, nothing = mass_matrix.rows, number(0)
    held = [[mass_matrix[i, j].free_symbols for j in range(n)] for i in range(n)]

    def slope(i: int, j: int, k: int) -> Expr:
        q = system.coordinates[k]
        return diff(mass_matrix[i, j], q) if q in held[i][j] else nothing

    def coefficient(i: int, j: int, k: int) -> Expr:
        if j == k:
            return slope(i, j, j) - slope(j, j, i) / 2
        return slope(i, j, k) + slope(i, k, j) - slope(j, k, i)

    found = list[Degrees | None]()
    for i, force in zip(range(n) if places is None else places, inertia, strict=True):
        quadratic = tuple(
            (value, system.speeds[j] * system.speeds[k])
            for j in range(n)
            for k in range(j, n)
            if not (value := coefficient(i, j, k)).is_zero
        )
        degrees = Degrees(number(0), (), quadratic)
        found.append(degrees if degrees.total == force else None)
    return found


def degrees(expressions: Sequence[Expr], speeds: Sequence[Expr]) -> list[Degrees | None]:
    """Return expressions by their degree in the speeds; None for those that aren't quadratic polynomials.

    The coefficients are derivatives where all speeds are zero, and their sum is compared with the expression.
    """
    if all(expression.is_zero for expression in expressions):
        return [Degrees(number(0), (), ())] * len(expressions)
    rest = dict.fromkeys(speeds, 0)
    try:
        first = jacobian(expressions, speeds)
        second = jacobian(first.entries, speeds).subs(rest)
        constants, first = [subs(each, rest) for each in expressions], first.subs(rest)
    except SymbodyError:  # undefined at rest
        return [None] * len(expressions)
    n = len(speeds)
    found = list[Degrees | None]()
    for i, (expression, constant) in enumerate(zip(expressions, constants, strict=True)):
        linear = tuple((first[i, j], speeds[j]) for j in range(n) if not first[i, j].is_zero)
        quadratic = tuple(
            (second[i * n + j, k] * (1 if j != k else number(1) / 2), speeds[j] * speeds[k])
            for j in range(n)
            for k in range(j, n)
            if not second[i * n + j, k].is_zero
        )
        polynomial = Degrees(constant, linear, quadratic)
        found.append(polynomial if polynomial.total == expression else None)
    return found
