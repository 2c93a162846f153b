"""Straight-line code of routines: the contents of a tape, in a form that can be transformed."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import chain, compress

from symbody.codegen.straight_line.instruction import Instruction, instructions_of, renumber
from symbody.symbolic import STAGES, Argument, Expr
from symbody.symbolic.numeric.tape import Tape

__all__ = ["Code", "Input", "arguments_of", "code_of", "code_of_tape", "prune"]


@dataclass(frozen=True)
class Input:
    """An entry of an argument, and the user's name for the variable."""

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

    @cached_property
    def first_input(self) -> int:
        """The place of the first input."""
        return len(self.constants)

    @cached_property
    def first_instruction(self) -> int:
        """The place of the first instruction's result."""
        return len(self.constants) + len(self.inputs)

    @cached_property
    def uses(self) -> Counter[int]:
        """How often each place is read, or is a result."""
        return Counter(chain(self.results, *(row.reads for row in self.instructions)))


def arguments_of(arguments: Sequence[Argument]) -> tuple[Input, ...]:
    """Return the entries of arguments, one after another."""
    return tuple(Input(a.name, i, str(v)) for a in arguments for i, v in enumerate(a.variables))


def code_of(arguments: Sequence[Argument], expressions: Sequence[Expr]) -> Code:
    """Lower expressions of the variables of arguments."""
    variables = [v for argument in arguments for v in argument.variables]
    stages = [STAGES.index(argument.stage) for argument in arguments for _ in argument.variables]
    return code_of_tape(Tape(variables, expressions, stages, "generate"), arguments_of(arguments))


def code_of_tape(tape: Tape, inputs: Sequence[Input]) -> Code:
    """Return the contents of a tape."""
    return Code(
        tuple(tape.constants),
        tuple(inputs),
        instructions_of(tape),
        tuple(tape.instruction_stages),
        tuple(tape.results),
    )


def prune(code: Code) -> Code:
    """Leave out the constants, inputs and instructions that no result needs."""
    needed = _needed(code)
    places, kept = [], 0
    for is_needed in needed:
        places.append(kept)
        kept += is_needed
    instructions = compress(code.instructions, needed[code.first_instruction :])
    return replace(
        code,
        constants=tuple(compress(code.constants, needed)),
        inputs=tuple(compress(code.inputs, needed[code.first_input :])),
        instructions=renumber(instructions, places),
        stages=tuple(compress(code.stages, needed[code.first_instruction :])),
        results=tuple(places[place] for place in code.results),
    )


def _needed(code: Code) -> list[bool]:
    """Return for each place whether a result needs it."""
    needed = [False] * (code.first_instruction + len(code.instructions))
    for place in code.results:
        needed[place] = True
    for number in range(len(code.instructions) - 1, -1, -1):
        if needed[code.first_instruction + number]:
            for place in code.instructions[number].reads:
                needed[place] = True
    return needed
