"""CasADi."""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import cache
from typing import Any

from ..tape import Operand, Tape
from .base import Algebra, Expression

try:
    import casadi
except ImportError:
    casadi = None


class CasADi(Algebra):
    """CasADi's scalar graphs (SX), with its own elimination of common subexpressions."""

    name = "CasADi"
    package = "casadi"

    def symbol(self, name: str) -> Expression:
        return _symbol(name)

    def sin(self, angle: Expression) -> Expression:
        return casadi.sin(angle)

    def cos(self, angle: Expression) -> Expression:
        return casadi.cos(angle)

    def sqrt(self, radicand: Expression | int) -> Expression:
        return math.sqrt(radicand) if isinstance(radicand, int) else casadi.sqrt(radicand)

    def jacobian(
        self, expressions: Sequence[Expression], symbols: Sequence[Expression]
    ) -> list[list[Expression]]:
        dense = casadi.densify(casadi.jacobian(casadi.vcat(expressions), casadi.vcat(symbols)))
        return [casadi.horzsplit(row) for row in casadi.vertsplit(dense)]

    def gradient(self, expression: Expression, symbols: Sequence[Expression]) -> list[Expression]:
        return _entries(casadi.gradient(expression, casadi.vcat(symbols)))

    def rate(
        self, expressions: Sequence[Expression], symbols: Sequence[Expression], rates: Sequence[Expression]
    ) -> list[Expression]:
        return _entries(casadi.jtimes(casadi.vcat(expressions), casadi.vcat(symbols), casadi.vcat(rates)))

    def compress(self, roots: Sequence[Expression]) -> Any:
        return casadi.cse(casadi.densify(casadi.vcat(roots)))

    def lower(self, compressed: Any) -> Tape:
        symbols = casadi.symvar(compressed)
        function = casadi.Function("f", [casadi.vcat(symbols)], [compressed])
        return _lower(function, [symbol.name() for symbol in symbols])


def _entries(column: Expression) -> list[Expression]:
    entries: list[Expression] = casadi.vertsplit(casadi.densify(column))
    return entries


@cache
def _symbol(name: str) -> Expression:
    """Return the symbol of this name: by itself CasADi makes another one at each call."""
    return casadi.SX.sym(name)


def _lower(function: Any, names: Sequence[str]) -> Tape:
    """Copy the instructions of a function with one input and one output, slot by slot of its work vector."""
    tape = Tape()
    work: dict[int, Operand] = {}
    outputs: list[Operand] = [0.0] * function.size1_out(0)
    for k in range(function.n_instructions()):
        arguments, results = function.instruction_input(k), function.instruction_output(k)
        match function.instruction_id(k):
            case casadi.OP_INPUT:
                work[results[0]] = tape.input(names[arguments[1]])
            case casadi.OP_CONST:
                work[results[0]] = float(function.instruction_constant(k))
            case casadi.OP_OUTPUT:
                outputs[results[1]] = work[arguments[0]]
            case operation:
                work[results[0]] = _emit(tape, operation, [work[a] for a in arguments])
    tape.outputs = outputs
    return tape


def _emit(tape: Tape, operation: int, operands: Sequence[Operand]) -> Operand:
    a = operands[0]
    match operation:
        case casadi.OP_ADD:
            return tape.emit("+", *operands)
        case casadi.OP_SUB:
            return tape.emit("-", *operands)
        case casadi.OP_MUL:
            return tape.emit("*", *operands)
        case casadi.OP_DIV:
            return tape.emit("/", *operands)
        case casadi.OP_NEG:
            return tape.emit("-", 0.0, a)
        case casadi.OP_SQ:
            return tape.emit("*", a, a)
        case casadi.OP_TWICE:
            return tape.emit("+", a, a)
        case casadi.OP_INV:
            return tape.emit("/", 1.0, a)
        case casadi.OP_SIN:
            return tape.emit("sin", a)
        case casadi.OP_COS:
            return tape.emit("cos", a)
        case casadi.OP_SQRT:
            return tape.emit("sqrt", a)
    raise NotImplementedError(f"CasADi operation {operation}")
