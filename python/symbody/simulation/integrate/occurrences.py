"""The events of many motions, in columns."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

__all__ = ["Occurrence", "Occurrences", "joined_occurrences", "no_occurrences"]

Array = NDArray[np.float64]
Indices = NDArray[np.int64]

Occurrence = tuple[int, float, Array, Array]
"""The number of an event, the instant, the state there, and its derivatives, shape (n, p)."""


@dataclass(frozen=True, eq=False)
class Occurrences:
    """The m events of k motions, by motion and then by instant.

    Attributes:
        case: the number of the motion, shape (m,).
        event: the number of the event, shape (m,).
        t: the instant, in s, shape (m,).
        state: the state there, shape (m, n), or (m, n + 1) with the work up to there.
        slopes: its derivatives by p parameters and initial values, shape (m, n, p).
    """

    case: Indices
    event: Indices
    t: Array
    state: Array
    slopes: Array

    def __len__(self) -> int:
        return len(self.case)

    def of(self, case: int) -> tuple[Occurrence, ...]:
        """Return the events of one motion."""
        own = range(*np.searchsorted(self.case, (case, case + 1)).tolist())
        return tuple((int(self.event[k]), float(self.t[k]), self.state[k], self.slopes[k]) for k in own)

    def last(self, cases: Indices) -> Indices:
        """Return the places of the last events of some motions, each of which has one."""
        places: Indices = np.searchsorted(self.case, cases, "right") - 1
        return places

    def renumbered(self, cases: Indices) -> Occurrences:
        """Return the events with other numbers of the motions.

        Args:
            cases: the new number of each motion, increasing.
        """
        return Occurrences(cases[self.case], self.event, self.t, self.state, self.slopes)

    def of_some(self, cases: Indices, places: Indices, size: int) -> Occurrences:
        """Return the events of some motions without derivatives, renumbered.

        Args:
            cases: the new number of each motion, increasing.
            places: which motions.
            size: the length of a state, n.
        """
        is_chosen = np.zeros(len(cases), dtype=bool)
        is_chosen[places] = True
        own = is_chosen[self.case]
        return Occurrences(
            cases[self.case[own]],
            self.event[own],
            self.t[own],
            self.state[own],
            np.empty((int(own.sum()), size, 0)),
        )


def no_occurrences(width: int, slopes: tuple[int, int]) -> Occurrences:
    """Return no events of vectors with a number of entries, and of derivatives of a shape."""
    none = np.empty(0, dtype=np.int64)
    return Occurrences(none, none, np.empty(0), np.empty((0, width)), np.empty((0, *slopes)))


def joined_occurrences(parts: Sequence[Occurrences]) -> Occurrences:
    """Return the events of several sets of motions, in the order of the motions."""
    names = ("case", "event", "t", "state", "slopes")
    case, *others = (np.concatenate([getattr(part, name) for part in parts]) for name in names)
    if (case[1:] < case[:-1]).any():
        order = np.argsort(case, kind="stable")
        case, others = case[order], [column[order] for column in others]
    return Occurrences(case, *others)
