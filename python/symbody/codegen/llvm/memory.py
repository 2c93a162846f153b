"""The workspace of a function: slots for values that cross blocks, then matrices and solutions."""

from __future__ import annotations

from symbody.codegen.straight_line.code import Code
from symbody.symbolic.numeric.kernel import kernel_workspace

__all__ = ["Memory"]


class Memory:
    """Where the matrices and solutions of linear systems are kept, for one lane.

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
            if row[0] == "factor":
                self.numbers[place] = len(self.numbers)
                self._add(place, kernel_workspace(row[1]))
            elif row[0] == "solve":
                self._add(place, len(row) - 2)

    def _add(self, place: int, size: int) -> None:
        self.areas[place] = (self.size, size)
        self.size += size
