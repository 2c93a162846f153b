"""The ends of motions on a device, as arrays."""

from __future__ import annotations

from dataclasses import dataclass
from enum import IntEnum

import numpy as np
from numpy.typing import NDArray

__all__ = ["REASONS", "Column", "Ending", "Endings"]

Array = NDArray[np.float64]


class Ending(IntEnum):
    """How a motion ended; the numbers are those of ``integrator.cu``. From `NOT_FINITE` on, it was left to the host."""

    RUNNING = 0
    COMPLETED = 1
    ENDED_BY_EVENT = 2
    NOT_FINITE = 3
    COLLAPSED = 4
    STALLED = 5
    DEFICIENT = 6
    UNBALANCED = 7
    SINGULAR = 8
    CROWDED = 9
    AT_POLE = 10


class Column(IntEnum):
    """The columns of the counts of a motion."""

    STATUS = 0
    REACHED = 1
    STEPS = 2
    REJECTED = 3
    EVALUATIONS = 4
    STIFF = 5
    HAPPENED = 6


REASONS = {
    Ending.NOT_FINITE: "a rate of the state is not a finite number there",
    Ending.COLLAPSED: "its step has collapsed there",
    Ending.STALLED: "its steps are so short that it would never end",
    Ending.DEFICIENT: "a linear system in the model has no unique solution",
    Ending.UNBALANCED: "its energy balance might be off",
    Ending.SINGULAR: "it comes near a singular position of its constraints",
    Ending.CROWDED: "it has more events than the device keeps",
    Ending.AT_POLE: "its accelerations are so large at its start that they may be infinite",
}
"""Why the host integrates a motion."""


@dataclass(frozen=True, eq=False)
class Endings:
    """The ends of k motions at N instants.

    Attributes:
        counts: how each ended, the instants that it reached, its cost, and its number of events, by `Column`.
        ends: the instant of its end, shape (k,).
        states: its states, shape (k, N, width); what was not reached has no meaning.
        events: the number, the instant and the state of each event, shape (k, most, 2 + width).
    """

    counts: NDArray[np.int64]
    ends: Array
    states: Array
    events: Array

    @property
    def status(self) -> NDArray[np.int64]:
        """How each motion ended, an `Ending`."""
        return self.counts[:, Column.STATUS]

    @property
    def is_over(self) -> NDArray[np.bool_]:
        """Which motions ended without trouble."""
        return np.isin(self.status, (Ending.COMPLETED, Ending.ENDED_BY_EVENT))

    @property
    def is_left(self) -> NDArray[np.bool_]:
        """Which motions the host must integrate."""
        return self.status >= Ending.NOT_FINITE
