"""One block of a function: instructions, the inputs and earlier values that they read, and what is kept of them."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from math import inf
from typing import TypeAlias

from symbody.codegen.llvm import linear_system
from symbody.codegen.llvm.memory import Memory
from symbody.codegen.llvm.operation import operation
from symbody.codegen.llvm.piece import Piece
from symbody.codegen.llvm.run import segments
from symbody.codegen.llvm.wave import wave_size, waves
from symbody.codegen.llvm.writer import Writer
from symbody.codegen.straight_line.code import Code, Instruction, operands

__all__ = ["BlockWriter", "Frame", "Load"]

Load: TypeAlias = Callable[[Writer, int], str]
"""Writes how an input, by its number, is loaded."""


@dataclass(frozen=True)
class Frame:
    """What the blocks of a function have in common.

    Attributes:
        code: what the instructions belong to.
        pack: how many angles of one state the processor takes at a time.
        load: how an input is loaded.
        slots: where values that cross blocks are kept, by place.
        uniform: where values that are the same for all states are found, by place.
        memory: where matrices and solutions are kept.
        are_waves_inlined: whether sines and cosines become a part of the code.
    """

    code: Code
    pack: int
    load: Load
    slots: Mapping[int, int]
    uniform: Mapping[int, int]
    memory: Memory
    are_waves_inlined: bool


class BlockWriter(Writer):
    """The text of one block."""

    def __init__(self, frame: Frame, lanes: int) -> None:
        super().__init__(lanes)
        self.frame, self.code = frame, frame.code
        self.values: dict[int, str] = {}
        self.runs = 0

    def piece(self, name: str, attribute: str) -> Piece:
        """Return the block as a function."""
        return Piece(name, tuple(self.lines), frozenset(self.helpers), attribute)

    def rows(self, rows: Sequence[int], stores: Sequence[tuple[int, str]]) -> None:
        """Write instructions, by number, and store values, by place, where they are awaited."""
        first = self.code.first_instruction
        waiting: dict[int, list[str]] = {}
        for place, target in stores:
            waiting.setdefault(place, []).append(target)
        # What is called keeps no value in a register: results are stored before the next call.
        most = inf if self.frame.are_waves_inlined else wave_size(self.lanes, self.frame.pack)
        for is_wave, segment in segments(self.code, rows, most):
            places = [first + k for k in segment]
            if is_wave:
                self._waves(places)
            for place in places:
                if not is_wave:
                    self._instruction(place, self.code.instructions[place - first])
                self._keep(place)
                self._store(place, waiting.pop(place, []))
        for place, targets in waiting.items():
            self._store(place, targets)

    def _instruction(self, place: int, row: Instruction) -> None:
        name, memory = row[0], self.frame.memory
        match name:
            case "factor":
                linear_system.factor(self, memory, place, row[1], self._all(operands(row)))
            case "solve":
                linear_system.solve(self, memory, place, row[1], self._all(row[2:]))
            case "component":
                self.values[place] = linear_system.component(self, memory, row[1], row[2])
            case _:
                self.values[place] = operation(self, name, self._all(operands(row)))

    def _all(self, places: Sequence[int]) -> list[str]:
        return [self.value(place) for place in places]

    def _waves(self, places: Sequence[int]) -> None:
        """Take the sines and cosines of some instructions together."""
        rows = [self.code.instructions[place - self.code.first_instruction] for place in places]
        angles = list(dict.fromkeys(angle for _, angle in rows))
        self.runs += 1
        run = self.runs if self.frame.are_waves_inlined else None
        pairs = waves(self, self._all(angles), self.frame.pack, run)
        both = dict(zip(angles, pairs, strict=True))
        for place, (name, angle) in zip(places, rows, strict=True):
            self.values[place] = both[angle][name == "cos"]

    def _keep(self, place: int) -> None:
        """Store a value that later blocks read."""
        if place in self.frame.slots:
            self.store(self.values[place], self._slot(place))

    def _store(self, place: int, targets: Sequence[str]) -> None:
        """Store a result as soon as it is there: values that wait take registers."""
        for target in targets:
            self.store(self.value(place), self._address(target))

    def _slot(self, place: int) -> str:
        return self.pointer("%work", self.frame.slots[place] * self.lanes)

    def _address(self, target: str) -> str:
        """Return where a result goes: ``@j`` stands for row j of the results of many states."""
        if not target.startswith("@"):
            return self.let(target)
        start = self.let(f"mul i64 %stride, {target[1:]}")
        return self.let(f"getelementptr double, ptr %out, i64 {self.let(f'add i64 {start}, %i')}")

    def value(self, place: int) -> str:
        """Return the name of the value at a place; loaded at its first use in a block."""
        if place < len(self.code.constants):
            return self.number(self.code.constants[place])
        if place not in self.values:
            self.values[place] = self._loaded(place)
        return self.values[place]

    def _loaded(self, place: int) -> str:
        if place in self.frame.uniform:
            pointer = self.pointer("%uniform", self.frame.uniform[place])
            return self.splat(self.let(f"load double, ptr {pointer}, align 8"))
        if place < self.code.first_instruction:
            return self.frame.load(self, place - self.code.first_input)
        return self.load(self._slot(place))
