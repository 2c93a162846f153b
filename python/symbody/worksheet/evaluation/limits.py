"""What keeps a worksheet from running forever, or from taking all memory of the machine."""

from __future__ import annotations

import os
import time
from dataclasses import dataclass
from pathlib import Path

from symbody.errors import WorksheetError

__all__ = ["Limits", "resident_memory"]

_PERIOD = 0.05
"""Seconds between two questions for the memory, as the answer takes longer than a step of a loop."""
_PAGES = Path("/proc/self/statm")


@dataclass
class Limits:
    """Seconds and bytes that a statement may take, nested calls, items of a sequence.

    Attributes:
        seconds: the time of a statement.
        memory: the bytes by which the process may grow during a statement.
        depth: nested calls of procedures.
        items: items of a sequence or a matrix.
        nested: the expressions that are being evaluated inside each other.
        deadline: when the time of the statement is over.
        resident: the memory of the process when the statement began; infinite outside of statements.
        asked: when the process was last asked for its memory.
    """

    seconds: float = 300.0
    memory: float = 2e9
    depth: int = 150
    items: int = 1_000_000
    nested: int = 0
    deadline: float = float("inf")
    resident: float = float("inf")
    asked: float = 0.0

    def start(self) -> None:
        """Begin a statement."""
        self.asked = time.monotonic()
        self.deadline = self.asked + self.seconds
        self.resident = resident_memory()
        self.nested = 0

    def check(self) -> None:
        """Raise an error if the statement has run for too long, or has taken too much memory."""
        now = time.monotonic()
        if now > self.deadline:
            raise self.exceeded()
        if now > self.asked + _PERIOD:
            self.asked = now
            self._check_memory()

    def _check_memory(self) -> None:
        if resident_memory() > self.resident + self.memory:
            raise WorksheetError(
                f"the statement took more than {self.memory / 1e9:g} GB of memory; it was stopped, and the next"
                " statement runs"
            )

    def exceeded(self) -> WorksheetError:
        """Return the error of a statement that has run for too long."""
        return WorksheetError(
            f"the statement ran for more than {self.seconds:g} s; it was stopped, and the next statement runs"
        )

    def check_items(self, items: float) -> None:
        """Raise an error for sequences, loops of sequences and matrices of too many items."""
        if items > self.items:
            raise WorksheetError(f"{items:.0f} items; expected at most {self.items}")


def resident_memory() -> float:
    """Return the bytes of memory that this process holds now; 0 where the system does not tell.

    >>> resident_memory() >= 0
    True
    """
    try:
        pages = int(_PAGES.read_text(encoding="ascii").split()[1])
    except (OSError, ValueError, IndexError):
        return 0.0
    return float(pages * os.sysconf("SC_PAGE_SIZE"))
