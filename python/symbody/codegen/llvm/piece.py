"""Pieces of modules: the functions of blocks, and the names of the helpers that these call."""

from __future__ import annotations

from dataclasses import dataclass

__all__ = ["CHECKED", "CLEAR", "SINCOS", "Helper", "Piece"]

SINCOS, CHECKED = "sincos", "checked_sincos"
"""Sine and cosine of small angles, which are inlined; and of all angles, which are called."""


@dataclass(frozen=True, order=True)
class Helper:
    """A helper for vectors: sine and cosine, or a function that calls one of the system for each lane.

    >>> print(Helper("atan2", 4))
    atan2_4
    """

    name: str
    lanes: int

    def __str__(self) -> str:
        return f"{self.name}_{self.lanes}"


CLEAR = Helper("clear", 1)
"""Sets bytes to zero. It is called, since LLVM compares each memset that it sees with every later store."""

_TYPED = "ptr noalias %in, ptr noalias %out, ptr noalias %work, ptr noalias %uniform, i64 %i, i64 %stride"


@dataclass(frozen=True)
class Piece:
    """A function without a result; all pieces have the same arguments.

    Attributes:
        name: its name.
        lines: what it does.
        helpers: the helpers that it calls.
        attribute: whether it is inlined where it is called.
    """

    name: str
    lines: tuple[str, ...]
    helpers: frozenset[Helper] = frozenset()
    attribute: str = "noinline"

    def definition(self, linkage: str = "") -> str:
        """Return its text."""
        head = f"define {linkage} void @{self.name}({_TYPED}) {self.attribute} alignstack(64) {{"
        return "\n".join([head, *self.lines, "  ret void", "}", ""])

    def call_by_address(self, number: int) -> str:
        """Return a function of this name that calls the piece by its address in the table ``@parts``."""
        return f"""\
define internal void @{self.name}({_TYPED}) alwaysinline {{
  %place = getelementptr ptr, ptr @parts, i64 {number}
  %part = load ptr, ptr %place
  call void %part({_TYPED.replace(" noalias", "")})
  ret void
}}
"""
