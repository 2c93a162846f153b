"""Instructions of straight-line code, and the operations that they carry out."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from enum import StrEnum
from typing import NamedTuple

from symbody.symbolic.numeric.tape import Tape

__all__ = [
    "ARITHMETIC",
    "LINEAR_SYSTEMS",
    "WAVES",
    "Instruction",
    "Operation",
    "instructions_of",
    "renumber",
]


class Operation(StrEnum):
    """The operation of an instruction, by its name on the tape; functions come last."""

    ADD = "add"
    SUB = "sub"
    MUL = "mul"
    DIV = "div"
    NEG = "neg"
    FACTOR = "factor"
    SOLVE = "solve"
    COMPONENT = "component"
    SQRT = "sqrt"
    SIN = "sin"
    COS = "cos"
    TAN = "tan"
    ASIN = "asin"
    ACOS = "acos"
    ATAN = "atan"
    ATAN2 = "atan2"
    SINH = "sinh"
    COSH = "cosh"
    TANH = "tanh"
    EXP = "exp"
    LOG = "log"
    ABS = "Abs"
    SIGN = "sign"
    MIN = "Min"
    MAX = "Max"
    POWER = "Power"
    SELECT = "select"


ARITHMETIC = frozenset({Operation.ADD, Operation.SUB, Operation.MUL, Operation.DIV, Operation.NEG})
LINEAR_SYSTEMS = frozenset({Operation.FACTOR, Operation.SOLVE, Operation.COMPONENT})
WAVES = frozenset({Operation.SIN, Operation.COS})

_BY_NAME = {operation.value: operation for operation in Operation}


class Instruction(NamedTuple):
    """An operation on values of earlier places.

    Attributes:
        operation: what is done.
        reads: the places that it reads: the n^2 entries of a matrix to factorise, row by row; for a system to solve,
            the place of the factorisation, then the right side.
        component: which component of a solution; 0 for all other operations.
    """

    operation: Operation
    reads: tuple[int, ...]
    component: int = 0


def instructions_of(tape: Tape) -> tuple[Instruction, ...]:
    """Return the instructions of a tape, including the entries of linear systems, which it keeps in separate lists."""
    matrices, solutions = tape.factorizations, tape.solves
    instructions = []
    for name, *numbers in tape.instructions:
        operation = _BY_NAME[name]
        if operation not in LINEAR_SYSTEMS:
            instructions.append(Instruction(operation, tuple(numbers)))
        elif operation is Operation.FACTOR:
            instructions.append(Instruction(operation, tuple(matrices[numbers[0]][1])))
        elif operation is Operation.SOLVE:
            matrix, right = solutions[numbers[0]]
            instructions.append(Instruction(operation, (matrix, *right)))
        else:
            place, component = numbers
            instructions.append(Instruction(operation, (place,), component))
    return tuple(instructions)


def renumber(instructions: Iterable[Instruction], places: Sequence[int]) -> tuple[Instruction, ...]:
    """Return the same operations on other places.

    Args:
        instructions: the instructions to change.
        places: the new place of each old one.

    >>> renumber([Instruction(Operation.ADD, (0, 2))], [5, 6, 7])[0].reads
    (5, 7)
    """
    return tuple(
        Instruction(operation, tuple([places[place] for place in reads]), component)
        for operation, reads, component in instructions
    )
