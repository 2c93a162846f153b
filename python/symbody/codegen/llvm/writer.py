"""Lines of a function in LLVM's intermediate representation, on vectors of some lanes."""

from __future__ import annotations

from symbody.codegen.llvm.helper import Helper
from symbody.codegen.llvm.vector import constant, vector_type

__all__ = ["Writer"]


class Writer:
    """The lines of one function, and the names in it; one lane is a plain double."""

    def __init__(self, lanes: int) -> None:
        self.lanes = lanes
        self.V, self.mask = vector_type(lanes), vector_type(lanes, "i1")
        self.suffix = "f64" if lanes == 1 else f"v{lanes}f64"
        self.lines: list[str] = []
        self.helpers: set[Helper] = set()
        self.count = 0

    def let(self, instruction: str) -> str:
        """Write an instruction and return the name of its result."""
        name = f"%x{self.count}"
        self.count += 1
        self.lines.append(f"  {name} = {instruction}")
        return name

    def number(self, value: float) -> str:
        """Return a constant in all lanes."""
        return constant(value, self.lanes)

    def intrinsic(self, name: str, *values: str) -> str:
        """Call one of LLVM's own functions of vectors."""
        arguments = ", ".join(f"{self.V} {value}" for value in values)
        return self.let(f"call {self.V} @llvm.{name}.{self.suffix}({arguments})")

    def pointer(self, array: str, index: int) -> str:
        """Return the address of a double in an array."""
        return self.let(f"getelementptr double, ptr {array}, i64 {index}")

    def load(self, pointer: str) -> str:
        """Load a vector."""
        return self.let(f"load {self.V}, ptr {pointer}, align 8")

    def input(self, pointer: str) -> str:
        """Load what nothing changes: it may be loaded again rather than kept."""
        return self.let(f"load {self.V}, ptr {pointer}, align 8, !invariant.load !1")

    def store(self, value: str, pointer: str) -> None:
        """Store a vector."""
        self.lines.append(f"  store {self.V} {value}, ptr {pointer}, align 8")

    def splat(self, value: str) -> str:
        """Return a double in all lanes."""
        if self.lanes == 1:
            return value
        one = self.let(f"insertelement {self.V} poison, double {value}, i64 0")
        zeros = vector_type(self.lanes, "i32")
        return self.let(f"shufflevector {self.V} {one}, {self.V} poison, {zeros} zeroinitializer")

    def lane(self, vector: str, lane: int) -> str:
        """Return the double in a lane."""
        return vector if self.lanes == 1 else self.let(f"extractelement {self.V} {vector}, i32 {lane}")

    def gathered(self, values: list[str]) -> str:
        """Return the vector of a double for each lane."""
        if self.lanes == 1:
            return values[0]
        vector = "poison"
        for lane, value in enumerate(values):
            vector = self.let(f"insertelement {self.V} {vector}, double {value}, i32 {lane}")
        return vector
