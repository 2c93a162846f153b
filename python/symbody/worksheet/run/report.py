"""What became of a sheet: its statements, the comparisons, the exit status."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from symbody.worksheet.check import Verdict

__all__ = ["INTERRUPTED", "NOT_READABLE", "Report"]

#: Exit statuses.
FAILED, DIFFERENT, NOT_READABLE, INTERRUPTED = 1, 2, 3, 130


@dataclass(slots=True)
class Report:
    """What became of a sheet's statements."""

    statements: int = 0
    failed: int = 0
    verdicts: list[Verdict] = field(default_factory=list)

    def count(self, *kinds: str) -> int:
        """Return how many comparisons came out in one of these ways."""
        return sum(verdict.kind in kinds for verdict in self.verdicts)

    def __str__(self) -> str:
        noun = "statement" if self.statements == 1 else "statements"
        return (
            f"{self.statements} {noun}, {self.failed} failed, {self.count('equal', 'differs')} compared, "
            f"{self.count('differs')} different, {self.count('not comparable')} not comparable"
        )

    @property
    def status(self) -> int:
        """The exit status."""
        return FAILED if self.failed else DIFFERENT if self.count("differs") else 0
