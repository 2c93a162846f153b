"""The one measure for all: straight-line code whose instructions are counted and run.

Whatever a system derives is lowered to a `Tape` before it is counted, so that everybody's operations are the same
operations, and the numbers that show two systems to agree come from the very instructions that were counted.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import reduce

Operand = int | float
"""Slot of an earlier instruction (int) or a constant (float)."""

Term = tuple[float, Operand]
Factor = tuple[Operand, Fraction]

ARITHMETIC: dict[str, Callable[[float, float], float]] = {
    "+": lambda a, b: a + b,
    "-": lambda a, b: a - b,
    "*": lambda a, b: a * b,
    "/": lambda a, b: a / b,
}
FUNCTIONS: dict[str, Callable[..., float]] = {
    name: getattr(math, name) for name in ("sin", "cos", "tan", "sqrt", "exp", "log", "pow", "atan2")
}


@dataclass(frozen=True)
class Operations:
    """Operation counts; a subtraction is an addition, and so is a change of sign that no sum absorbs."""

    additions: int
    multiplications: int
    divisions: int
    functions: int

    @property
    def total(self) -> int:
        """All of them."""
        return self.additions + self.multiplications + self.divisions + self.functions


@dataclass(frozen=True)
class Instruction:
    """An operation on operands; that of an input is its name, and it has none."""

    operation: str
    operands: tuple[Operand, ...]


class Tape:
    """Straight-line code under construction; operations on constants alone are folded and cost nothing."""

    def __init__(self) -> None:
        self.instructions: list[Instruction] = []
        self.outputs: list[Operand] = []
        self._powers: dict[tuple[Operand, Fraction], Operand] = {}

    def input(self, name: str) -> Operand:
        """Read the named input."""
        return self._append(Instruction(name, ()))

    def emit(self, operation: str, *operands: Operand) -> Operand:
        """Append one operation, or fold it."""
        if all(isinstance(operand, float) for operand in operands):
            return _function(operation)(*operands)
        return self._append(Instruction(operation, operands))

    def sum(self, terms: Iterable[Term]) -> Operand:
        """Add coefficient times operand; coefficients of one are free, signs become subtractions."""
        positive: list[Operand] = []
        negative: list[Operand] = []
        for coefficient, operand in terms:
            scaled = operand if abs(coefficient) == 1 else self.emit("*", abs(coefficient), operand)
            (positive if coefficient > 0 else negative).append(scaled)
        if positive:
            return self._fold("-", [self._fold("+", sorted(positive, key=_is_slot)), *negative])
        return self.emit("-", 0.0, self._fold("+", negative))

    def product(self, coefficient: float, factors: Iterable[Factor]) -> Operand:
        """Multiply powers; those with negative exponents share one division."""
        above: list[Operand] = []
        below: list[Operand] = []
        for base, exponent in factors:
            power = self.power(base, abs(exponent))
            if isinstance(power, float):
                coefficient *= power if exponent > 0 else 1 / power
            else:
                (above if exponent > 0 else below).append(power)
        if abs(coefficient) != 1 or not above:
            above, coefficient = [coefficient, *above], 1.0
        value = self._fold("*", above)
        if below:
            value = self.emit("/", value, self._fold("*", below))
        return value if coefficient > 0 else self.emit("-", 0.0, value)

    def power(self, base: Operand, exponent: Fraction) -> Operand:
        """Raise to a positive power, once: by repeated squaring, and of the square root for halves."""
        if exponent == 1:
            return base
        if (base, exponent) not in self._powers:
            self._powers[base, exponent] = self._power(base, exponent)
        return self._powers[base, exponent]

    def _power(self, base: Operand, exponent: Fraction) -> Operand:
        if exponent.denominator == 2:
            root = self.emit("sqrt", base)
            return self.power(root, exponent * 2)
        if exponent.denominator != 1:
            return self.emit("pow", base, float(exponent))
        if exponent.numerator % 2:
            return self.emit("*", self.power(base, exponent - 1), base)
        half = self.power(base, exponent / 2)
        return self.emit("*", half, half)

    def count(self) -> Operations:
        """Count the operations."""
        counts = Counter(i.operation for i in self.instructions if i.operands)
        return Operations(
            additions=counts.pop("+", 0) + counts.pop("-", 0),
            multiplications=counts.pop("*", 0),
            divisions=counts.pop("/", 0),
            functions=counts.total(),
        )

    def evaluate(self, value_of: Callable[[str], float]) -> list[float]:
        """Run the instructions with the given inputs."""
        values: list[float] = []
        for instruction in self.instructions:
            if instruction.operands:
                arguments = (v if isinstance(v, float) else values[v] for v in instruction.operands)
                values.append(_function(instruction.operation)(*arguments))
            else:
                values.append(value_of(instruction.operation))
        return [v if isinstance(v, float) else values[v] for v in self.outputs]

    def _append(self, instruction: Instruction) -> int:
        self.instructions.append(instruction)
        return len(self.instructions) - 1

    def _fold(self, operation: str, operands: Sequence[Operand]) -> Operand:
        return reduce(lambda a, b: self.emit(operation, a, b), operands)


def _function(operation: str) -> Callable[..., float]:
    return ARITHMETIC.get(operation) or FUNCTIONS[operation]


def _is_slot(operand: Operand) -> bool:
    """Sort key that makes constants meet and fold."""
    return isinstance(operand, int)
