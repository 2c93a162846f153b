"""Random expressions of every kind. A seed gives one expression.

Numbers are exact: a decimal that isn't a double, such as a product of many digits, is rounded when it
is printed.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from random import Random

import symbody.symbolic as sym
from symbody.errors import SymbodyError
from symbody.symbolic import Expr

SYMBOLS = (sym.symbols("p", positive=True), *sym.symbols("a b1 c10 theta_B D"))
COORDINATES = sym.functions_of_time("x y2 phi")
NAMES = {e.name: e for e in (*SYMBOLS, *COORDINATES)}
FUNCTIONS = (sym.sin, sym.cos, sym.tan, sym.atan, sym.tanh, sym.exp, sym.Abs, sym.sign)
f, g = sym.function("f"), sym.function("g")


@dataclass(frozen=True)
class Maker:
    """Draws expressions; what a choice makes impossible, such as a division by zero, is drawn again."""

    random: Random
    only_common: bool = False  # nothing that reads otherwise in Maple

    def expression(self, depth: int) -> Expr:
        while True:
            try:
                return self._draw(depth)
            except SymbodyError:
                continue

    def _draw(self, depth: int) -> Expr:
        if depth == 0:
            return self._leaf()
        kinds: Sequence[Callable[[int], Expr]] = (
            self._sum, self._sum, self._sum, self._product, self._product, self._quotient, self._power,
            self._function, self._function, self._application,
        )  # fmt: skip
        if not self.only_common:
            kinds = (*kinds, self._of_two, self._piecewise)
        return self.random.choice(kinds)(depth - 1)

    def _leaf(self) -> Expr:
        draw = self.random.random
        if draw() < 0.5:
            return self.random.choice(SYMBOLS)
        if draw() < 0.6:
            return sym.time_derivative(
                self.random.choice(COORDINATES), self.random.choice((0, 0, 1, 2, 3, 4))
            )
        if draw() < 0.2:
            return self.random.choice((sym.pi, sym.t))
        return self._number()

    def _number(self) -> Expr:
        whole = self.random.randint(-12, 12)
        return sym.number(self.random.choice((whole, Fraction(whole, 7), 10**25 + whole)))

    def _several(self, depth: int) -> list[Expr]:
        return [self.expression(self.random.randint(0, depth)) for _ in range(self.random.randint(2, 4))]

    def _sum(self, depth: int) -> Expr:
        total = sym.number(0)
        for term in self._several(depth):
            total = total + term if self.random.random() < 0.6 else total - term
        return total

    def _product(self, depth: int) -> Expr:
        total = sym.number(1)
        for factor in self._several(depth):
            total *= factor
        return total

    def _quotient(self, depth: int) -> Expr:
        return self.expression(depth) / self._divisor(depth)

    def _divisor(self, depth: int) -> Expr:
        return self.random.choice((self._sum, self._sum, self._function, lambda _: self._product(0)))(depth)

    def _power(self, depth: int) -> Expr:
        match self.random.randrange(4):
            case 0:
                return self.expression(depth) ** self.random.choice((2, 3))
            case 1:
                return self._divisor(depth) ** self.random.choice((-1, -2))
            case 2:
                return self._sum(depth) ** self.random.choice(
                    (Fraction(1, 2), Fraction(-3, 2), Fraction(1, 3))
                )
            case _:
                return self.expression(depth) ** self.expression(0)

    def _function(self, depth: int) -> Expr:
        return self.random.choice(FUNCTIONS)(self.expression(depth))

    def _application(self, depth: int) -> Expr:
        args = (self.expression(depth), self.expression(0))
        if self.random.random() < 0.5:
            return f.derivative([self.random.randint(0, 2), self.random.randint(0, 2)], *args)
        return g(args[0], sym.t)

    def _of_two(self, depth: int) -> Expr:
        return self.random.choice((sym.atan2, sym.Min, sym.Max))(self.expression(depth), self.expression(0))

    def _piecewise(self, depth: int) -> Expr:
        return sym.Piecewise((self.expression(depth), self.expression(0)), otherwise=self.expression(0))


def expression(seed: int, depth: int = 4, *, only_common: bool = False) -> Expr:
    """Return the expression of this seed."""
    return Maker(Random(seed), only_common).expression(depth)


def doubling(levels: int) -> Expr:
    """Return a graph whose tree doubles with every level: x -> x*sin(x) + 1."""
    x = sym.symbols("x")
    for _ in range(levels):
        x = x * sym.sin(x) + 1
    return x
