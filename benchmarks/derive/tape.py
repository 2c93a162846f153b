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
        self._multiples: dict[Term, Operand] = {}
        self._uses = Counter[Operand]()

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
        for coefficient, signed in terms:
            operand, sign = self._without_sign(signed)
            scaled = operand if abs(coefficient) == 1 else self._multiple(abs(coefficient), operand)
            (positive if coefficient * sign > 0 else negative).append(scaled)
        if positive:
            return self._fold("-", [self._fold("+", sorted(positive, key=_is_slot)), *negative])
        return self._opposite(self._fold("+", negative))

    def _multiple(self, coefficient: float, operand: Operand) -> Operand:
        """Multiply by a number, once."""
        if (coefficient, operand) not in self._multiples:
            self._multiples[coefficient, operand] = self.emit("*", coefficient, operand)
        return self._multiples[coefficient, operand]

    def product(self, coefficient: float, factors: Iterable[Factor]) -> Operand:
        """Multiply powers; those with negative exponents share one division."""
        above: list[Operand] = []
        below: list[Operand] = []
        for signed, exponent in factors:
            base, sign = self._without_sign(signed) if exponent.denominator == 1 else (signed, 1)
            coefficient *= sign ** (exponent.numerator % 2)
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
        return value if coefficient > 0 else self._opposite(value)

    def _without_sign(self, operand: Operand) -> tuple[Operand, int]:
        """Return what an operand is the opposite of, and -1; or itself, and 1."""
        if isinstance(operand, int) and _is_opposite(self.instructions[operand]):
            return self.instructions[operand].operands[1], -1
        return operand, 1

    def _opposite(self, operand: Operand) -> Operand:
        return self.emit("-", 0.0, operand)

    def absorb_signs(self) -> None:
        """Turn round the sums that are used for their opposites alone: a subtraction among their terms does it."""
        needed = self._needed()
        self._uses = Counter(each for slot in needed for each in self.instructions[slot].operands)
        self._uses.update(self.outputs)
        for slot in filter(lambda slot: _is_opposite(self.instructions[slot]), needed):
            value = self.instructions[slot].operands[1]
            if isinstance(value, int) and self._turns(value):
                self.instructions[slot] = self._turned(value)

    def _turns(self, slot: Operand) -> bool:
        if not isinstance(slot, int) or self._uses[slot] > 1:
            return False
        instruction = self.instructions[slot]
        if instruction.operation == "+":
            return any(map(self._turns, instruction.operands))
        return instruction.operation == "-" and not _is_opposite(instruction)

    def _turned(self, slot: int) -> Instruction:
        """Return the opposite of a sum that turns; the terms that turn with it change in place."""
        first, second = self.instructions[slot].operands
        if self.instructions[slot].operation == "-":
            return Instruction("-", (second, first))
        turning, other = (first, second) if self._turns(first) else (second, first)
        assert isinstance(turning, int)
        self.instructions[turning] = self._turned(turning)
        return Instruction("-", (turning, other))

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
        """Count the operations on which the outputs depend: signs that a sum has absorbed are left out."""
        instructions = (self.instructions[slot] for slot in self._needed())
        counts = Counter(i.operation for i in instructions if i.operands)
        return Operations(
            additions=counts.pop("+", 0) + counts.pop("-", 0),
            multiplications=counts.pop("*", 0),
            divisions=counts.pop("/", 0),
            functions=counts.total(),
        )

    def _needed(self) -> list[int]:
        needed = {output for output in self.outputs if isinstance(output, int)}
        for slot in reversed(range(len(self.instructions))):
            if slot in needed:
                needed |= {each for each in self.instructions[slot].operands if isinstance(each, int)}
        return sorted(needed)

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


def _is_opposite(instruction: Instruction) -> bool:
    """Tell whether an instruction changes a sign: a constant zero minus a value."""
    first = instruction.operands[0] if instruction.operation == "-" else None
    return isinstance(first, float) and first == 0


def _is_slot(operand: Operand) -> bool:
    """Sort key that makes constants meet and fold."""
    return isinstance(operand, int)
