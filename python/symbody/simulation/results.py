"""Results: what the motions of a batch have given so far, as arrays."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from enum import IntEnum
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


class Status(IntEnum):
    """What became of a case."""

    NOT_RUN = 0
    COMPLETED = 1
    ENDED_BY_EVENT = 2
    FAILED = 3


@dataclass(frozen=True, eq=False)
class Results:
    """The results of k cases at N instants; what was not computed is NaN.

    Attributes:
        status: what became of each case, a `Status`.
        reached: how many of the instants each case reached.
        t_reached: the time up to which each case is known; NaN where it never began.
        messages: why a case ended before its time; the empty text if it didn't.
        counts: a row a case: steps, rejected steps, evaluations, Jacobians.
        outputs: one array for each name, a row a case.
        states: a state for each case and instant; without instants if states are not kept.
        occurrences: for each case the events: which, when, and the state there.
    """

    status: NDArray[np.int8]
    reached: NDArray[np.int64]
    t_reached: Array
    messages: NDArray[np.object_]
    counts: NDArray[np.int64]
    outputs: Array
    states: Array
    occurrences: NDArray[np.object_]

    @classmethod
    def empty(cls, cases: int, instants: int, kept: int, state: int, outputs: int) -> Results:
        """Return results of cases that have not been run; ``kept`` instants have room for their states."""
        occurrences = np.empty(cases, dtype=object)
        occurrences[:] = [()] * cases
        return cls(
            np.zeros(cases, dtype=np.int8),
            np.zeros(cases, dtype=np.int64),
            np.full(cases, np.nan),
            np.full(cases, "", dtype=object),
            np.zeros((cases, COUNTS), dtype=np.int64),
            np.full((cases, outputs, instants), np.nan),
            np.full((cases, kept, state), np.nan),
            occurrences,
        )

    @property
    def missing(self) -> NDArray[np.intp]:
        """The cases that have not been run."""
        return np.flatnonzero(self.status == Status.NOT_RUN)

    def put(self, cases: NDArray[np.intp], part: Results) -> None:
        """Put in what some of the cases gave."""
        for name in _COLUMNS:
            getattr(self, name)[cases] = getattr(part, name)

    def arrays(self) -> dict[str, NDArray[Any]]:
        """Return all as arrays of numbers and texts, for a file."""
        case = [k for k, events in enumerate(self.occurrences) for _ in events]
        events = [event for events in self.occurrences for event in events]
        size = self.states.shape[2]
        return {
            "status": self.status,
            "reached": self.reached,
            "t_reached": self.t_reached,
            "messages": self.messages.astype(np.str_),
            "counts": self.counts,
            "outputs": self.outputs,
            "states": self.states,
            "event_case": np.array(case, dtype=np.int64),
            "event_number": np.array([event for event, _, _ in events], dtype=np.int64),
            "event_t": np.array([t for _, t, _ in events], dtype=np.float64),
            "event_state": np.array([state for _, _, state in events], dtype=np.float64).reshape(-1, size),
        }

    @classmethod
    def of_arrays(cls, arrays: Mapping[str, NDArray[Any]]) -> Results:
        """Return the results of `arrays`."""
        occurrences = np.empty(len(arrays["status"]), dtype=object)
        occurrences[:] = [()] * len(occurrences)
        events: Iterable[tuple[Any, ...]] = zip(
            *(arrays[f"event_{name}"] for name in ("case", "number", "t", "state")), strict=True
        )
        for case, event, t, state in events:
            occurrences[case] += ((int(event), float(t), state),)
        columns = {name: arrays[name] for name in _COLUMNS if name not in ("messages", "occurrences")}
        return cls(**columns, messages=arrays["messages"].astype(object), occurrences=occurrences)


COUNTS = 5
"""Numbers of the statistics of a case: steps, rejected, evaluations, Jacobians, stiff."""

_COLUMNS = ("reached", "t_reached", "messages", "counts", "outputs", "states", "occurrences", "status")
