"""A sequence of instructions as functions of LLVM's: cut into blocks, which share a workspace."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Iterable, Mapping, Sequence

from symbody.codegen.llvm.angles_first import angles_first
from symbody.codegen.llvm.block import BlockWriter, Frame, Load
from symbody.codegen.llvm.memory import Memory
from symbody.codegen.llvm.piece import Piece
from symbody.codegen.llvm.run import are_inlined
from symbody.codegen.llvm.wave import wave_size
from symbody.codegen.straight_line.code import Code, operands
from symbody.codegen.straight_line.cut import Cut, cut

__all__ = ["Function"]

BLOCK, SMALL_BLOCK = 1000, 500
"""Instructions of a function, as compilers take a time that grows faster than the length; and of one of long code."""

LONG = 8000
"""Instructions from which on the time to compile counts more than the last percents of speed."""

_WAVES = {"sin", "cos"}


class Function:
    """Instructions for some lanes.

    Args:
        code: what the instructions belong to.
        name: the functions' name, before the number of the block.
        rows: the numbers of the instructions.
        lanes: states in a vector.
        pack: how many angles of one state the processor takes at a time.
        load: how an input is loaded.
        uniform: where values that are the same for all states are found, by place.
    """

    def __init__(
        self,
        code: Code,
        name: str,
        rows: Iterable[int],
        lanes: int,
        pack: int,
        load: Load,
        uniform: Mapping[int, int] | None = None,
    ) -> None:
        self.code, self.name, self.lanes = code, name, lanes
        self.order = _ordered(code, list(rows))
        places = {code.first_instruction + k: code.first_instruction + n for n, k in enumerate(self.order)}
        self.cut = _cut(code, self.order, places)
        old = {new: place for place, new in places.items()}
        slots = {old[new]: slot for new, slot in self.cut.slots.items()}
        self.memory = Memory(code, self.cut.size)
        inlined = are_inlined(code, self.order, wave_size(lanes, pack))
        self.frame = Frame(code, pack, load, slots, dict(uniform or {}), self.memory, inlined)

    @property
    def blocks(self) -> int:
        """The number of blocks; at least one."""
        return max(len(self.cut.starts) - 1, 1)

    def pieces(self, stores: Sequence[tuple[int, str]]) -> list[Piece]:
        """Return the blocks; each stores the results that it makes, the last one also the others."""
        pieces, attribute = [], "alwaysinline" if self.blocks == 1 else "noinline"
        for block, here in enumerate(self._shared_out(stores)):
            rows = self.order[self.cut.starts[block] : self.cut.starts[block + 1]] if self.order else []
            writer = BlockWriter(self.frame, lanes=self.lanes)
            writer.rows(rows, here)
            pieces.append(writer.piece(f"{self.name}{block}", attribute))
        return pieces

    def _shared_out(self, stores: Sequence[tuple[int, str]]) -> list[list[tuple[int, str]]]:
        """Return what each block stores."""
        number = {self.code.first_instruction + k: n for n, k in enumerate(self.order)}
        here: list[list[tuple[int, str]]] = [[] for _ in range(self.blocks)]
        for place, target in stores:
            block = bisect_right(self.cut.starts, number[place]) - 1 if place in number else -1
            here[block].append((place, target))
        return here

    def calls(self, i: str, stride: str, uniform: str, out: str = "%out") -> str:
        """Return the calls of the blocks, with the memory that they share."""
        lines = [f"  %work = alloca double, i64 {max(self.memory.size, 1) * self.lanes}, align 64"]
        arguments = f"ptr %in, ptr {out}, ptr %work, ptr {uniform}, i64 {i}, i64 {stride}"
        lines += [f"  call void @{self.name}{block}({arguments})" for block in range(self.blocks)]
        return "\n".join(lines)


def _ordered(code: Code, rows: list[int]) -> list[int]:
    """Return the rows with sines and cosines together."""
    first = code.first_instruction
    position = {first + k: first + new for new, k in enumerate(rows)}
    reads = [[position.get(p, 0) for p in operands(code.instructions[k])] for k in rows]
    waves = [code.instructions[k][0] in _WAVES for k in rows]
    return [rows[new] for new in angles_first(reads, waves, first)]


def _cut(code: Code, order: Sequence[int], places: Mapping[int, int]) -> Cut:
    """Cut the instructions into blocks; factorisations and solutions are kept elsewhere than in slots."""
    first = code.first_instruction
    reads = [[places.get(p, 0) if p >= first else p for p in operands(code.instructions[k])] for k in order]
    held = [first + n for n, k in enumerate(order) if code.instructions[k][0] in {"factor", "solve"}]
    return cut(reads, first, BLOCK if len(order) < LONG else SMALL_BLOCK, held)
