"""Lower n-ary expressions to a tape, each distinct node once.

An engine says what one of its nodes is (a `Shape`); the rest is common to SymPy and SymEngine.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from .tape import Operand, Tape


@dataclass(frozen=True)
class Number:
    """A constant."""

    value: float
    parts: tuple[Any, ...] = ()


@dataclass(frozen=True)
class Leaf:
    """A symbol, a function of time or its derivative."""

    name: str
    parts: tuple[Any, ...] = ()


@dataclass(frozen=True)
class Sum:
    """Coefficients times parts."""

    coefficients: tuple[float, ...]
    parts: tuple[Any, ...]


@dataclass(frozen=True)
class Product:
    """A coefficient and powers of parts."""

    coefficient: float
    exponents: tuple[Fraction, ...]
    parts: tuple[Any, ...]


@dataclass(frozen=True)
class Call:
    """A function of its parts."""

    function: str
    parts: tuple[Any, ...]


Shape = Number | Leaf | Sum | Product | Call


class Lowering:
    """A tape and the operands of the nodes on it."""

    def __init__(self, shape_of: Callable[[Any], Shape]):
        self.tape = Tape()
        self._shape_of = shape_of
        self._operands: dict[Hashable, Operand] = {}

    def define(self, leaf: Any, node: Any) -> None:
        """Let a leaf stand for a node, as the intermediate quantities of a common subexpression elimination do."""
        self._operands[leaf] = self.operand(node)

    def output(self, nodes: Iterable[Any]) -> Tape:
        """Make these nodes the outputs."""
        self.tape.outputs = [self.operand(node) for node in nodes]
        return self.tape

    def operand(self, root: Any) -> Operand:
        """Return the operand of a node; iterative, since graphs can be deeper than Python's stack."""
        pending: list[tuple[Any, Shape | None]] = [(root, None)]
        while pending:
            node, shape = pending.pop()
            if node in self._operands:
                continue
            if shape is not None:
                self._operands[node] = self._emit(shape, [self._operands[p] for p in shape.parts])
                continue
            shape = self._shape_of(node)
            pending.append((node, shape))
            pending.extend((part, None) for part in reversed(shape.parts))
        return self._operands[root]

    def _emit(self, shape: Shape, operands: Sequence[Operand]) -> Operand:
        match shape:
            case Number(value):
                return float(value)
            case Leaf(name):
                return self.tape.input(name)
            case Sum(coefficients):
                return self.tape.sum(zip(coefficients, operands, strict=True))
            case Product(coefficient, exponents):
                return self.tape.product(coefficient, zip(operands, exponents, strict=True))
            case Call(function):
                return self.tape.emit(function, *operands)
