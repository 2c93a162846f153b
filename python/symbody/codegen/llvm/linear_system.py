"""Linear systems in machine code: matrices and right sides are stored lane by lane, the kernel does the rest."""

from __future__ import annotations

from collections.abc import Sequence

from symbody.codegen.llvm.helper import CLEAR
from symbody.codegen.llvm.memory import Memory
from symbody.codegen.llvm.writer import Writer

__all__ = ["component", "factor", "solve"]

_MANY = 64
"""Zeros that are stored together rather than one by one."""


def factor(w: Writer, memory: Memory, place: int, size: int, entries: Sequence[str]) -> None:
    """Factorise the matrix of the instruction at a place."""
    _store(w, memory.areas[place], entries)
    for lane in range(w.lanes):
        pointer = _address(w, memory.areas[place], lane)
        w.lines.append(f"  call void @symbody_factor(i64 {size}, ptr {pointer})")


def solve(w: Writer, memory: Memory, place: int, matrix: int, right: Sequence[str]) -> None:
    """Solve the system of the instruction at a place; the solution takes the place of the right side."""
    _store(w, memory.areas[place], right)
    for lane in range(w.lanes):
        factors, solution = _address(w, memory.areas[matrix], lane), _address(w, memory.areas[place], lane)
        number = memory.numbers[matrix]
        w.lines.append(
            f"  call void @symbody_solve(i64 {len(right)}, ptr {factors}, ptr {solution}, i64 {number})"
        )


def component(w: Writer, memory: Memory, solution: int, index: int) -> str:
    """Return a component of a solution."""
    area = memory.areas[solution]
    loads = [w.let(f"load double, ptr {_address(w, area, lane, index)}, align 8") for lane in range(w.lanes)]
    return w.gathered(loads)


def _store(w: Writer, area: tuple[int, int], values: Sequence[str]) -> None:
    """Store values lane by lane; many zeros at once, since each line takes time to compile."""
    zero = w.number(0.0)
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
    start, size = area
    return w.pointer("%work", start * w.lanes + lane * size + entry)
