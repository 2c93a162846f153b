"""Straight-line code of routines: what the tape holds, in a form that can be taken apart."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any, TypeAlias

from symbody.symbolic import STAGES, Argument, Expr
from symbody.symbolic.numeric.tape import Tape

__all__ = [
    "Code",
    "Input",
    "Instruction",
    "arguments_of",
    "code_of",
    "code_of_tape",
    "operands",
    "pruned",
    "with_operands",
]

Instruction: TypeAlias = tuple[Any, ...]
"""As the tape's, but with all places in it: ``("factor", size, *places)``, ``("solve", place, *places)``."""


@dataclass(frozen=True)
class Input:
    """An entry of an argument, and the user's name of the variable."""

    array: str
    index: int
    name: str


@dataclass(frozen=True)
class Code:
    """Instructions in static single assignment, sorted by stage.

    Places are numbered as on the tape: constants, inputs, then the results of the instructions.
    """

    constants: tuple[float, ...]
    inputs: tuple[Input, ...]
    instructions: tuple[Instruction, ...]
    stages: tuple[int, ...]
    results: tuple[int, ...]

    @property
    def first_input(self) -> int:
        """The place of the first input."""
        return len(self.constants)

    @property
    def first_instruction(self) -> int:
        """The place of the first instruction's result."""
        return len(self.constants) + len(self.inputs)


def operands(instruction: Instruction) -> tuple[int, ...]:
    """Return the places that an instruction reads."""
    match instruction[0]:
        case "factor":
            return instruction[2:]
        case "component":
            return instruction[1:2]
    return instruction[1:]


def with_operands(instruction: Instruction, places: Sequence[int]) -> Instruction:
    """Return the same operation on other places."""
    match instruction[0]:
        case "factor":
            return (*instruction[:2], *places)
        case "component":
            return ("component", *places, instruction[2])
    return (instruction[0], *places)


def arguments_of(arguments: Sequence[Argument]) -> tuple[Input, ...]:
    """Return the entries of arguments, one after another."""
    return tuple(Input(a.name, i, str(v)) for a in arguments for i, v in enumerate(a.variables))


def code_of(arguments: Sequence[Argument], expressions: Sequence[Expr]) -> Code:
    """Lower expressions of the variables of arguments."""
    variables = [v for argument in arguments for v in argument.variables]
    stages = [STAGES.index(argument.stage) for argument in arguments for _ in argument.variables]
    return code_of_tape(Tape(variables, expressions, stages, "generate"), arguments_of(arguments))


def code_of_tape(tape: Tape, inputs: Sequence[Input]) -> Code:
    """Return what a tape holds, all in its instructions."""
    systems = _Systems(tape)
    return Code(
        tuple(tape.constants),
        tuple(inputs),
        tuple(systems.spelled(row) for row in tape.instructions),
        tuple(tape.instruction_stages),
        tuple(tape.results),
    )


class _Systems:
    """The lists of a tape that its instructions refer to by number."""

    def __init__(self, tape: Tape) -> None:
        self.matrices, self.solutions = tape.factorizations, tape.solves

    def spelled(self, row: Instruction) -> Instruction:
        if row[0] == "factor":
            size, entries = self.matrices[row[1]]
            return ("factor", size, *entries)
        if row[0] == "solve":
            matrix, right = self.solutions[row[1]]
            return ("solve", matrix, *right)
        return row


def pruned(code: Code) -> Code:
    """Leave out the constants, inputs and instructions that no result needs."""
    needed = _needed(code)
    kept = {old: new for new, old in enumerate(place for place, used in enumerate(needed) if used)}

    def part(values: Sequence[Any], first: int) -> Iterator[Any]:
        return (value for place, value in enumerate(values, first) if needed[place])

    return replace(
        code,
        constants=tuple(part(code.constants, 0)),
        inputs=tuple(part(code.inputs, code.first_input)),
        instructions=tuple(
            with_operands(row, [kept[place] for place in operands(row)])
            for row in part(code.instructions, code.first_instruction)
        ),
        stages=tuple(part(code.stages, code.first_instruction)),
        results=tuple(kept[place] for place in code.results),
    )


def _needed(code: Code) -> list[bool]:
    needed = [False] * (code.first_instruction + len(code.instructions))
    for place in code.results:
        needed[place] = True
    for number in range(len(code.instructions) - 1, -1, -1):
        if needed[code.first_instruction + number]:
            for place in operands(code.instructions[number]):
                needed[place] = True
    return needed
