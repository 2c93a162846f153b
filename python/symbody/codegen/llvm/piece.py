"""Pieces, of which modules are put together: functions for blocks of code, and the names of what these call."""

from __future__ import annotations

from dataclasses import dataclass

__all__ = ["CHECKED", "CLEAR", "SINCOS", "Helper", "Piece"]

SINCOS, CHECKED = "sincos", "checked_sincos"
"""Sine and cosine of small angles; and of all, for those that are called rather than made part of the code."""


@dataclass(frozen=True, order=True)
class Helper:
    """A function for vectors: sine and cosine, or one that calls a function of the system for each lane.

    >>> print(Helper("atan2", 4))
    atan2_4
    """

    name: str
    lanes: int

    def __str__(self) -> str:
        return f"{self.name}_{self.lanes}"


CLEAR = Helper("clear", 1)
"""Sets bytes to zero; called, since LLVM compares what it knows to set memory with every store after it."""

_TYPED = "ptr noalias %in, ptr noalias %out, ptr noalias %work, ptr noalias %uniform, i64 %i, i64 %stride"


@dataclass(frozen=True)
class Piece:
    """A function without result; all have the same arguments.

    Attributes:
        name: its name.
        lines: what it does.
        helpers: what it calls, beside functions of the system.
        attribute: whether it becomes a part of what calls it.
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
        """Return a function of this name that calls the one whose address has a place in the table ``@parts``."""
        return f"""\
define internal void @{self.name}({_TYPED}) alwaysinline {{
  %place = getelementptr ptr, ptr @parts, i64 {number}
  %part = load ptr, ptr %place
  call void %part({_TYPED.replace(" noalias", "")})
  ret void
}}
"""
