"""SymPy."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from typing import Any

from ..lowering import Call, Leaf, Lowering, Number, Product, Shape, Sum
from ..tape import Tape
from .base import Algebra, Expression

try:
    import sympy
    from sympy.core.function import AppliedUndef
except ImportError:
    sympy = None


class SymPy(Algebra):
    """SymPy, with the common subexpression elimination it has by default."""

    name = "SymPy"
    package = "sympy"

    def symbol(self, name: str) -> Expression:
        return sympy.Symbol(name)

    def sin(self, angle: Expression) -> Expression:
        return sympy.sin(angle)

    def cos(self, angle: Expression) -> Expression:
        return sympy.cos(angle)

    def sqrt(self, radicand: Expression | int) -> Expression:
        return sympy.sqrt(radicand)

    def jacobian(
        self, expressions: Sequence[Expression], symbols: Sequence[Expression]
    ) -> list[list[Expression]]:
        return [[sympy.diff(expression, symbol) for symbol in symbols] for expression in expressions]

    def compress(self, roots: Sequence[Expression]) -> Any:
        return sympy.cse(list(roots))

    def lower(self, compressed: Any) -> Tape:
        replacements, reduced = compressed
        lowering = Lowering(shape_of)
        for symbol, expression in replacements:
            lowering.define(symbol, expression)
        return lowering.output(reduced)


def shape_of(node: Expression) -> Shape:
    """Say what a SymPy node is."""
    if not node.free_symbols:
        return Number(float(node))
    if isinstance(node, sympy.Symbol | sympy.Derivative | AppliedUndef):
        return Leaf(_leaf_name(node))
    if isinstance(node, sympy.Function):
        return Call(node.func.__name__, node.args)
    if node.is_Add:
        terms = [term.as_coeff_Mul() for term in node.args]
        return Sum(tuple(float(c) for c, _ in terms), tuple(part for _, part in terms))
    coefficient, rest = node.as_coeff_Mul()
    powers = [factor.as_base_exp() for factor in sympy.Mul.make_args(rest)]
    return Product(
        coefficient=float(coefficient),
        exponents=tuple(Fraction(int(e.p), int(e.q)) for _, e in powers),
        parts=tuple(base for base, _ in powers),
    )


def _leaf_name(leaf: Expression) -> str:
    """Return x for x(t) and x' for its derivative."""
    if isinstance(leaf, sympy.Derivative):
        return _leaf_name(leaf.expr) + "'" * int(leaf.derivative_count)
    return str(leaf.name)
