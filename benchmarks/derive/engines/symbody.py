"""symbody: its graph has no repeated subexpressions, so that nothing is left to compress."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from symbody import Expr
from symbody.codegen.straight_line.code import Code, code_of
from symbody.codegen.straight_line.instruction import Operation
from symbody.symbolic import STAGES, Argument, free_symbols

from ..tape import Operand, Tape
from .base import Engine

ARITHMETIC = {Operation.ADD: "+", Operation.SUB: "-", Operation.MUL: "*", Operation.DIV: "/"}


class Symbody(Engine):
    """The subject."""

    name = "symbody"
    package = "symbody"

    def compress(self, roots: Sequence[Expr]) -> Sequence[Expr]:
        return roots

    def lower(self, compressed: Any) -> Tape:
        variables = sorted(free_symbols(compressed), key=str)
        return _lower(code_of([Argument("x", "all inputs", tuple(variables), STAGES[0])], compressed))


def _lower(code: Code) -> Tape:
    """Copy the instructions of the code that `generate` prints."""
    tape = Tape()
    places: list[Operand] = [*code.constants, *(tape.input(each.name) for each in code.inputs)]
    for operation, reads, _ in code.instructions:
        operands = [places[place] for place in reads]
        if operation is Operation.NEG:
            places.append(tape.emit("-", 0.0, *operands))
        else:
            places.append(tape.emit(ARITHMETIC.get(operation, operation.value), *operands))
    tape.outputs = [places[place] for place in code.results]
    return tape
