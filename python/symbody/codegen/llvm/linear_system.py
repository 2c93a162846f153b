"""Linear systems in machine code: matrices and right sides are stored lane by lane, the kernel does the rest."""

from __future__ import annotations

from collections.abc import Sequence
from math import isqrt

from symbody.codegen.llvm.piece import CLEAR
from symbody.codegen.llvm.writer import Writer
from symbody.codegen.straight_line.code import Code
from symbody.codegen.straight_line.instruction import Instruction, Operation
from symbody.symbolic.numeric.kernel import kernel_workspace

__all__ = ["Memory", "component", "factor", "solve"]

_MANY = 64
"""Zeros that are stored together rather than one by one."""


class Memory:
    """The storage of the matrices and solutions of linear systems, for one lane.

    Attributes:
        areas: start and size of each factorisation and solution, by the place of its instruction.
        numbers: the number of each factorisation among those of the code, by the place of its instruction.
        size: all of it, in doubles.
    """

    def __init__(self, code: Code, slots: int) -> None:
        self.areas: dict[int, tuple[int, int]] = {}
        self.numbers: dict[int, int] = {}
        self.size = slots
        for place, row in enumerate(code.instructions, code.first_instruction):
            match row.operation:
                case Operation.FACTOR:
                    self.numbers[place] = len(self.numbers)
                    self._add(place, kernel_workspace(isqrt(len(row.reads))))
                case Operation.SOLVE:
                    self._add(place, len(row.reads) - 1)

    def _add(self, place: int, size: int) -> None:
        self.areas[place] = (self.size, size)
        self.size += size


def factor(w: Writer, memory: Memory, place: int, entries: Sequence[str]) -> None:
    """Factorise the matrix of the instruction at a place."""
    _store(w, memory.areas[place], entries)
    for lane in range(w.lanes):
        pointer = _address(w, memory.areas[place], lane)
        w.lines.append(f"  call void @symbody_factor(i64 {isqrt(len(entries))}, ptr {pointer})")


def solve(w: Writer, memory: Memory, place: int, matrix: int, right: Sequence[str]) -> None:
    """Solve the system of the instruction at a place; the solution takes the place of the right side.

    Args:
        w: the function that needs it.
        memory: where the matrix and the solution are kept.
        place: the place of the instruction.
        matrix: the place of the factorisation.
        right: the entries of the right side.
    """
    _store(w, memory.areas[place], right)
    for lane in range(w.lanes):
        factors, solution = _address(w, memory.areas[matrix], lane), _address(w, memory.areas[place], lane)
        number = memory.numbers[matrix]
        w.lines.append(
            f"  call void @symbody_solve(i64 {len(right)}, ptr {factors}, ptr {solution}, i64 {number})"
        )


def component(w: Writer, memory: Memory, row: Instruction) -> str:
    """Return a component of a solution."""
    area = memory.areas[row.reads[0]]
    loads = [
        w.let(f"load double, ptr {_address(w, area, lane, row.component)}, align 8")
        for lane in range(w.lanes)
    ]
    return w.gathered(loads)


def _store(w: Writer, area: tuple[int, int], values: Sequence[str]) -> None:
    """Store values lane by lane; many zeros at once, since each line takes time to compile."""
    zero = w.words["zero"]
    are_set = sum(value == zero for value in values) >= _MANY
    for lane in range(w.lanes):
        if are_set:
            w.helpers.add(CLEAR)
            w.lines.append(f"  call void @{CLEAR}(ptr {_address(w, area, lane)}, i64 {8 * len(values)})")
        for entry, value in enumerate(values):
            if are_set and value == zero:
                continue
            one = w.lane(value, lane)
            w.lines.append(f"  store double {one}, ptr {_address(w, area, lane, entry)}, align 8")


def _address(w: Writer, area: tuple[int, int], lane: int, entry: int = 0) -> str:
    """Return the address of an entry, of one lane."""
    start, size = area
    return w.let(f"getelementptr double, ptr %work, i64 {start * w.lanes + lane * size + entry}")
