"""Quadratic forms with rational coefficients, and the roots of those that are squares: ``x**2 + 2*x*y + y**2``."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from itertools import combinations

from symbody.deferred import cached_property
from symbody.symbolic._core import Expr, number

from .reading import parts_of
from .rewrite import expand
from .squares import square_root
from .summands import summands

Pair = tuple[Expr, Expr]


@dataclass(frozen=True)
class QuadraticForm:
    """A sum of products of two variables.

    Attributes:
        coefficients: the coefficients by pair of variables, each pair in the order of names.

    >>> from symbody import symbols
    >>> x, y = symbols("x y")
    >>> square, rest = QuadraticForm.of(x**2), QuadraticForm.of(y**2 - 2 * x * y)
    >>> square.root_with(rest, 1)
    x - y
    """

    coefficients: Mapping[Pair, Fraction]

    @classmethod
    def of(cls, expression: Expr) -> QuadraticForm | None:
        """Return the form of a homogeneous polynomial of degree 2 without decimals; None for other expressions."""
        found = dict[Pair, Fraction]()
        for term in summands(expand(expression)):
            coefficient, variables = _factors(term)
            if len(variables) != _DEGREE or not all(each.is_variable for each in variables):
                return None
            pair = _pair(*variables)
            found[pair] = found.get(pair, Fraction(0)) + coefficient
        return cls(found)

    @cached_property
    def squared(self) -> frozenset[Expr]:
        """The variables whose squares occur."""
        return frozenset(one for one, other in self.coefficients if one == other)

    @cached_property
    def unsquared(self) -> frozenset[Expr]:
        """The variables whose squares do not occur."""
        return frozenset(each for pair in self.coefficients for each in pair) - self.squared

    def root_with(self, other: QuadraticForm, sign: int) -> Expr | None:
        """Return the linear form whose square is this form plus or minus another; None if that isn't a square."""
        if not other.unsquared <= self.squared or not self.unsquared <= other.squared:
            return None
        total = {**self.coefficients}
        for pair, coefficient in other.coefficients.items():
            total[pair] = total.get(pair, Fraction(0)) + sign * coefficient
        return _root_of_square({pair: coefficient for pair, coefficient in total.items() if coefficient})


def _root_of_square(form: Mapping[Pair, Fraction]) -> Expr | None:
    sizes = {one: square_root(square) for (one, other), square in form.items() if one == other}
    if not sizes or None in sizes.values():
        return None
    lead = next(iter(sizes))
    root = {
        each: (size or Fraction(0)) * (-1 if form.get(_pair(lead, each), 0) < 0 else 1)
        for each, size in sizes.items()
    }
    square = {_pair(a, b): 2 * root[a] * root[b] for a, b in combinations(root, 2)}
    square |= {(each, each): factor**2 for each, factor in root.items()}
    return sum((factor * each for each, factor in root.items()), start=number(0)) if square == form else None


def _factors(term: Expr) -> tuple[Fraction, list[Expr]]:
    """Return the numeric factor of a product and its other factors, the base of a square twice."""
    coefficient, others = Fraction(1), list[Expr]()
    for factor in parts_of(term, "product"):
        if factor.is_number and not factor.is_decimal:
            coefficient *= Fraction(*factor.ratio)
        elif factor.kind == "power" and factor.args[1] == _TWO:
            others += [factor.args[0]] * 2
        else:
            others.append(factor)
    return coefficient, others


def _pair(one: Expr, other: Expr) -> Pair:
    return (one, other) if str(one) <= str(other) else (other, one)


_DEGREE = 2
_TWO = number(_DEGREE)
