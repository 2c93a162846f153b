"""symbody: its graph has no repeated subexpressions, so that nothing is left to compress."""

from __future__ import annotations

import math
from collections.abc import Sequence
from fractions import Fraction
from typing import Any

from symbody import Expr

from ..lowering import Call, Leaf, Lowering, Number, Product, Shape, Sum
from ..tape import Tape
from .base import Engine


class Symbody(Engine):
    """The subject."""

    name = "symbody"
    package = "symbody"

    def compress(self, roots: Sequence[Expr]) -> Sequence[Expr]:
        return roots

    def lower(self, compressed: Any) -> Tape:
        return Lowering(shape_of, lambda node: node.id).output(compressed)


def shape_of(node: Expr) -> Shape:
    """Say what a node of symbody is."""
    match node.kind:
        case "number" | "constant":
            return Number(float(node))
        case "symbol" | "time_function":
            return Leaf(str(node))
        case "sum":
            terms = [_coefficient(term) for term in node.args]
            return Sum(tuple(c for c, _ in terms), tuple(part for _, part in terms))
        case "product" | "power":
            return _product(node)
        case "function":
            return Call(str(node.name), node.args)
    raise NotImplementedError(f"symbody expression of kind {node.kind}")


def _coefficient(node: Expr) -> tuple[float, Expr]:
    """Split the number off a multiple of another node."""
    if node.kind == "product" and len(node.args) == 2 and node.args[0].kind == "number":
        return float(node.args[0]), node.args[1]
    return 1.0, node


def _product(node: Expr) -> Product:
    arguments = [node] if node.kind == "power" else node.args
    factors = [_power(argument) for argument in arguments if argument.kind != "number"]
    return Product(
        coefficient=math.prod(float(argument) for argument in arguments if argument.kind == "number"),
        exponents=tuple(exponent for _, exponent in factors),
        parts=tuple(base for base, _ in factors),
    )


def _power(factor: Expr) -> tuple[Expr, Fraction]:
    if factor.kind != "power":
        return factor, Fraction(1)
    base, exponent = factor.args
    return base, Fraction(str(exponent))
