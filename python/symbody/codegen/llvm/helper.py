"""Names of the functions that blocks call, of which each module holds its own."""

from __future__ import annotations

from dataclasses import dataclass

__all__ = ["CHECKED", "CLEAR", "SINCOS", "Helper"]

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
