"""SymEngine."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from typing import Any

from ..lowering import Call, Leaf, Lowering, Number, Product, Shape, Sum
from ..tape import Tape
from .base import Algebra, Expression

try:
    import symengine
except ImportError:
    symengine = None


class SymEngine(Algebra):
    """SymEngine: SymPy's algebra in C++."""

    name = "SymEngine"
    package = "symengine"

    def symbol(self, name: str) -> Expression:
        return symengine.Symbol(name)

    def sin(self, angle: Expression) -> Expression:
        return symengine.sin(angle)

    def cos(self, angle: Expression) -> Expression:
        return symengine.cos(angle)

    def sqrt(self, radicand: Expression | int) -> Expression:
        return symengine.sqrt(radicand)

    def jacobian(
        self, expressions: Sequence[Expression], symbols: Sequence[Expression]
    ) -> list[list[Expression]]:
        return [[symengine.diff(expression, symbol) for symbol in symbols] for expression in expressions]

    def compress(self, roots: Sequence[Expression]) -> Any:
        return symengine.cse(list(roots))

    def lower(self, compressed: Any) -> Tape:
        replacements, reduced = compressed
        lowering = Lowering(shape_of)
        for symbol, expression in replacements:
            lowering.define(symbol, expression)
        return lowering.output(reduced)


def shape_of(node: Expression) -> Shape:
    """Say what a SymEngine node is."""
    if node.is_Number:
        return Number(float(node))
    if node.is_Symbol:
        return Leaf(str(node.name))
    if node.is_Add:
        terms = [_coefficient(term) for term in node.args]
        return Sum(tuple(c for c, _ in terms), tuple(part for _, part in terms))
    if node.is_Mul or node.is_Pow:
        coefficient, rest = _coefficient(node)
        powers = [_power(factor) for factor in (rest.args if rest.is_Mul else [rest])]
        return Product(coefficient, tuple(e for _, e in powers), tuple(base for base, _ in powers))
    return Call(type(node).__name__, node.args)


def _coefficient(node: Expression) -> tuple[float, Expression]:
    """Split the leading number off a product."""
    if node.is_Mul and node.args[0].is_Number:
        first, *rest = node.args
        return float(first), symengine.Mul(*rest)
    return 1.0, node


def _power(factor: Expression) -> tuple[Expression, Fraction]:
    if not factor.is_Pow:
        return factor, Fraction(1)
    base, exponent = factor.args
    return base, Fraction(str(exponent))
