"""Text of LLVM's intermediate representation: types, constants and lines on vectors of some lanes; one is a double."""

from __future__ import annotations

import struct
from collections.abc import Iterable, Sequence
from functools import cache
from typing import TypeAlias

from symbody.codegen.llvm.piece import Helper

__all__ = ["Template", "Writer", "constants", "splat", "vector_type"]

Template: TypeAlias = tuple[str, ...]
"""Instructions, one per line: ``{0}``, ``{1}``, ... are the values given, then the results of the lines before."""


@cache
def vector_type(lanes: int, element: str = "double") -> str:
    """Return the type of so many elements.

    >>> vector_type(4), vector_type(1, "i1")
    ('<4 x double>', 'i1')
    """
    return element if lanes == 1 else f"<{lanes} x {element}>"


def constants(values: Iterable[float], lanes: int) -> list[str]:
    """Return doubles, exactly, each in all lanes.

    >>> constants([0.1], 1)
    ['0x3FB999999999999A']
    """
    bits = (struct.unpack("<Q", struct.pack("<d", value))[0] for value in values)
    texts = [f"0x{each:016X}" for each in bits]
    return texts if lanes == 1 else [f"<{', '.join([f'double {text}'] * lanes)}>" for text in texts]


def splat(lanes: int, value: int) -> Template:
    """Return the lines that bring a double, the value of this number, into all lanes."""
    if lanes == 1:
        return ()
    zeros = vector_type(lanes, "i32")
    return (
        f"insertelement {{V}} poison, double {{{value}}}, i64 0",
        f"shufflevector {{V}} {{{value + 1}}}, {{V}} poison, {zeros} zeroinitializer",
    )


class Writer:
    """The lines of one function, and the names in it."""

    def __init__(self, lanes: int) -> None:
        self.lanes = lanes
        self.V = vector_type(lanes)
        zero, one = constants([0.0, 1.0], lanes)
        self.words = {
            "V": self.V,
            "mask": vector_type(lanes, "i1"),
            "suffix": "f64" if lanes == 1 else f"v{lanes}f64",
            "zero": zero,
            "one": one,
        }
        self.lines: list[str] = []
        self.helpers: set[Helper] = set()
        self.count = 0

    def write(self, template: Template, *values: object) -> list[str]:
        """Write instructions and return the names of their results."""
        known = list(values)
        for line in template:
            known.append(f"%x{self.count}")
            self.count += 1
            self.lines.append(f"  {known[-1]} = {line.format(*known[:-1], **self.words)}")
        return [str(name) for name in known[len(values) :]]

    def let(self, instruction: str) -> str:
        """Write an instruction and return the name of its result."""
        name = f"%x{self.count}"
        self.count += 1
        self.lines.append(f"  {name} = {instruction}")
        return name

    def store(self, value: str, address: Template, number: int) -> None:
        """Store a vector where the last line of a template says, of a number."""
        pointer = self.write(address, number)[-1]
        self.lines.append(f"  store {self.V} {value}, ptr {pointer}, align 8")

    def lane(self, vector: str, lane: int) -> str:
        """Return the double in a lane."""
        return vector if self.lanes == 1 else self.let(f"extractelement {self.V} {vector}, i32 {lane}")

    def gathered(self, values: Sequence[str]) -> str:
        """Return the vector of a double for each lane."""
        if self.lanes == 1:
            return values[0]
        vector = "poison"
        for lane, value in enumerate(values):
            vector = self.let(f"insertelement {self.V} {vector}, double {value}, i32 {lane}")
        return vector
