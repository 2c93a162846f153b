"""Instructions cut into blocks, each of which becomes an LLVM function; the blocks share a workspace.

The slots of the workspace hold values that a later block reads; the matrices and solutions of linear systems follow.
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from math import inf
from typing import NamedTuple

from symbody.codegen.llvm import linear_system
from symbody.codegen.llvm.angles import angles_first, are_inlined, segments
from symbody.codegen.llvm.linear_system import Memory
from symbody.codegen.llvm.operation import FUSED, SYSTEM, TEMPLATES
from symbody.codegen.llvm.piece import Helper, Piece
from symbody.codegen.llvm.wave import wave_size, waves
from symbody.codegen.llvm.writer import Template, Writer, constants, splat
from symbody.codegen.straight_line.code import Code
from symbody.codegen.straight_line.cut import Cut, cut
from symbody.codegen.straight_line.fusion import fused_products, fused_sums
from symbody.codegen.straight_line.instruction import WAVES, Instruction, Operation

__all__ = ["Blocks", "Store"]

BLOCK, SMALL_BLOCK = 1000, 500
"""Instructions of a block, and of a block of long code, at most: the time to compile grows faster than the length."""

LONG = 8000
"""The number of instructions from which the time to compile counts more than the last percents of speed."""

_SLOT: Template = ("getelementptr double, ptr %work, i64 {0}",)
_UNIFORM: Template = ("getelementptr double, ptr %uniform, i64 {0}", "load double, ptr {1}, align 8")


class Store(NamedTuple):
    """The storage of the value of a place: the address that a template makes of a number."""

    place: int
    address: Template
    number: int


@dataclass(frozen=True)
class _Shared:
    """The common data of the blocks.

    Attributes:
        code: what the instructions belong to.
        lanes: states in a vector.
        pack: how many angles of one state the processor takes at a time.
        constants: the text of each constant.
        loads: how each input is loaded, by its number.
        slots: where values that cross blocks are kept, by place.
        uniform: where values that are the same for all states are found, by place.
        memory: where matrices and solutions are kept.
        are_waves_inlined: whether sines and cosines are inlined rather than called.
    """

    code: Code
    lanes: int
    pack: int
    constants: Sequence[str]
    loads: Sequence[Template]
    slots: Mapping[int, int]
    uniform: Mapping[int, int]
    memory: Memory
    are_waves_inlined: bool


class Blocks:
    """Instructions for some lanes.

    Args:
        code: what the instructions belong to.
        name: the functions' name, before the number of the block.
        rows: the numbers of the instructions.
        lanes: states in a vector.
        pack: how many angles of one state the processor takes at a time.
        loads: how each input is loaded.
        uniform: where values that are the same for all states are found, by place.
    """

    def __init__(
        self,
        code: Code,
        name: str,
        rows: Iterable[int],
        lanes: int,
        pack: int,
        loads: Sequence[Template],
        uniform: Mapping[int, int] | None = None,
    ) -> None:
        self.code, self.name = code, name
        self.order = _ordered(code, list(rows))
        self.cut = _cut(code, self.order)
        slots = {code.first_instruction + self.order[n]: slot for n, slot in self.cut.slots.items()}
        inlined = are_inlined(code, self.order, wave_size(lanes, pack))
        memory, texts = Memory(code, self.cut.size), constants(code.constants, lanes)
        self.shared = _Shared(code, lanes, pack, texts, loads, slots, uniform or {}, memory, inlined)
        self.count = max(len(self.cut.starts) - 1, 1)

    def pieces(self, stores: Sequence[Store]) -> list[Piece]:
        """Return the blocks; each stores the results that it makes, the last one also the others."""
        pieces, attribute = [], "alwaysinline" if self.count == 1 else "noinline"
        for block, here in enumerate(self._shared_out(stores)):
            rows = self.order[self.cut.starts[block] : self.cut.starts[block + 1]] if self.order else []
            writer = _BlockWriter(self.shared)
            writer.rows(rows, here)
            helpers = frozenset(writer.helpers)
            pieces.append(Piece(f"{self.name}{block}", tuple(writer.lines), helpers, attribute))
        return pieces

    def _shared_out(self, stores: Sequence[Store]) -> list[list[Store]]:
        """Return what each block stores."""
        number = {self.code.first_instruction + k: n for n, k in enumerate(self.order)}
        here: list[list[Store]] = [[] for _ in range(self.count)]
        for store in stores:
            block = bisect_right(self.cut.starts, number[store.place]) - 1 if store.place in number else -1
            here[block].append(store)
        return here

    def calls(self, i: str, stride: str, uniform: str, out: str = "%out") -> str:
        """Return the calls of the blocks, with the memory that they share."""
        size = max(self.shared.memory.size, 1) * self.shared.lanes
        lines = [f"  %work = alloca double, i64 {size}, align 64"]
        arguments = f"ptr %in, ptr {out}, ptr %work, ptr {uniform}, i64 {i}, i64 {stride}"
        lines += [f"  call void @{self.name}{block}({arguments})" for block in range(self.count)]
        return "\n".join(lines)


def _ordered(code: Code, rows: list[int]) -> list[int]:
    """Return the rows with sines and cosines together."""
    are_waves = [code.instructions[k].operation in WAVES for k in rows]
    return [rows[n] for n in angles_first(_reads(code, rows), are_waves, 0)]


def _cut(code: Code, order: Sequence[int]) -> Cut:
    """Cut the instructions into blocks; factorisations and solutions are kept elsewhere than in slots."""
    own = {Operation.FACTOR, Operation.SOLVE}
    held = {n for n, k in enumerate(order) if code.instructions[k].operation in own}
    return cut(_reads(code, order), 0, BLOCK if len(order) < LONG else SMALL_BLOCK, held)


def _reads(code: Code, rows: Sequence[int]) -> list[list[int]]:
    """Return what each of some rows reads, by numbers among these; -1 for any other row."""
    first = code.first_instruction
    numbers = {first + k: n for n, k in enumerate(rows)}
    return [[numbers.get(place, -1) for place in code.instructions[k].reads] for k in rows]


class _BlockWriter(Writer):
    """The text of one block."""

    def __init__(self, shared: _Shared) -> None:
        super().__init__(shared.lanes)
        self.shared, self.code = shared, shared.code
        self.values: dict[int, str] = {}
        self.fused: dict[int, int] = {}
        self.runs = 0

    def rows(self, rows: Sequence[int], stores: Sequence[Store]) -> None:
        """Write instructions, by number; store results at once, since those that wait take registers."""
        first = self.code.first_instruction
        self.fused = fused_sums(self.code, rows)
        products = fused_products(self.code, rows)
        waiting: dict[int, list[Store]] = {}
        for store in stores:
            waiting.setdefault(store.place, []).append(store)
        # What is called keeps no value in a register: results are stored before the next call.
        most = inf if self.shared.are_waves_inlined else wave_size(self.lanes, self.shared.pack)
        for is_wave, segment in segments(self.code, rows, most):
            if is_wave:
                self._waves([first + k for k in segment])
            for k in segment:
                if first + k in products:
                    continue
                if not is_wave:
                    self._instruction(first + k, self.code.instructions[k])
                self._keep(first + k)
                self._store(waiting.pop(first + k, []))
        for awaited in waiting.values():
            self._store(awaited)

    def _instruction(self, place: int, row: Instruction) -> None:
        memory = self.shared.memory
        match row.operation:
            case Operation.FACTOR:
                linear_system.factor(self, memory, place, self._all(row.reads))
            case Operation.SOLVE:
                linear_system.solve(self, memory, place, row.reads[0], self._all(row.reads[1:]))
            case Operation.COMPONENT:
                self.values[place] = linear_system.component(self, memory, row)
            case operation if operation in SYSTEM:
                self.values[place] = self._of_system(SYSTEM[operation], self._all(row.reads))
            case operation if place in self.fused:
                number = self.fused[place]
                product = self.code.instructions[row.reads[number] - self.code.first_instruction]
                operands = self._all([*product.reads, row.reads[1 - number]])
                self.values[place] = self.write(FUSED[operation, number], *operands)[-1]
            case operation:
                self.values[place] = self.write(TEMPLATES[operation], *self._all(row.reads))[-1]

    def _of_system(self, name: str, values: Sequence[str]) -> str:
        """Call a function of the system; a vector goes to a helper that calls it for each lane."""
        function = name
        if self.lanes > 1:
            helper = Helper(name, self.lanes)
            self.helpers.add(helper)
            function = str(helper)
        arguments = ", ".join(f"{self.V} {value}" for value in values)
        return self.let(f"call {self.V} @{function}({arguments})")

    def _waves(self, places: Sequence[int]) -> None:
        """Take the sines and cosines of some instructions together."""
        rows = [self.code.instructions[place - self.code.first_instruction] for place in places]
        angles = list(dict.fromkeys(row.reads[0] for row in rows))
        self.runs += 1
        run = self.runs if self.shared.are_waves_inlined else None
        pairs = waves(self, self._all(angles), self.shared.pack, run)
        both = dict(zip(angles, pairs, strict=True))
        for place, row in zip(places, rows, strict=True):
            sine, cosine = both[row.reads[0]]
            self.values[place] = sine if row.operation is Operation.SIN else cosine

    def _keep(self, place: int) -> None:
        """Store a value that later blocks read."""
        if place in self.shared.slots:
            self.store(self.values[place], _SLOT, self.shared.slots[place] * self.lanes)

    def _store(self, stores: Iterable[Store]) -> None:
        for place, address, number in stores:
            self.store(self._value(place), address, number)

    def _all(self, places: Sequence[int]) -> list[str]:
        return [self._value(place) for place in places]

    def _value(self, place: int) -> str:
        """Return the name of the value at a place; loaded at its first use in a block."""
        if place < self.code.first_input:
            return self.shared.constants[place]
        if place not in self.values:
            self.values[place] = self._loaded(place)
        return self.values[place]

    def _loaded(self, place: int) -> str:
        shared = self.shared
        if place in shared.uniform:
            return self.write(_UNIFORM + splat(self.lanes, 2), shared.uniform[place])[-1]
        if place < self.code.first_instruction:
            number = place - self.code.first_input
            return self.write(shared.loads[number], number)[-1]
        load = "load {V}, ptr {1}, align 8"
        return self.write((*_SLOT, load), shared.slots[place] * self.lanes)[-1]
