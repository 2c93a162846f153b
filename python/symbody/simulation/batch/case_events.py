"""The events of the cases of a batch, put together as they come."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from symbody.simulation.integrate.occurrences import (
    Occurrence,
    Occurrences,
    joined_occurrences,
    no_occurrences,
)

__all__ = ["CaseEvents"]


class CaseEvents:
    """The events of k cases, in columns; ``events[case]`` has those of one case.

    Args:
        cases: the number of cases, k.
        width: the length of a state and the work.
        slopes: the shape of the derivatives of a state, (n, p).
    """

    def __init__(self, cases: int, width: int, slopes: tuple[int, int]) -> None:
        self._cases = cases
        self._parts = [no_occurrences(width, slopes)]

    def add(self, more: Occurrences) -> None:
        """Take the events of some cases."""
        if len(more):
            self._parts.append(more)

    @property
    def table(self) -> Occurrences:
        """All events, by case and then by instant."""
        if len(self._parts) > 1:
            self._parts = [joined_occurrences(self._parts)]
        return self._parts[0]

    def __len__(self) -> int:
        return self._cases

    def __getitem__(self, case: int) -> tuple[Occurrence, ...]:
        return self.table.of(int(np.arange(self._cases)[case]))

    def __iter__(self) -> Iterator[tuple[Occurrence, ...]]:
        return (self.table.of(case) for case in range(self._cases))
