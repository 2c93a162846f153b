"""The results of the motions of a batch so far, as arrays."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from enum import IntEnum
from typing import Any

import numpy as np
from numpy.typing import NDArray

from symbody.simulation.integrate.notices import Finding
from symbody.simulation.integrate.occurrences import Occurrences

from .case_events import CaseEvents

Array = NDArray[np.float64]


class Status(IntEnum):
    """The end of a case."""

    NOT_RUN = 0
    COMPLETED = 1
    ENDED_BY_EVENT = 2
    FAILED = 3


@dataclass(frozen=True, eq=False)
class Results:
    """The results of k cases at N instants; what was not computed is NaN.

    Attributes:
        status: how each case ended, a `Status`, shape (k,).
        reached: how many of the instants each case reached, shape (k,).
        t_reached: the last known instant of each case, NaN if it was not started, shape (k,).
        messages: why each case ended early; the empty text if it did not.
        counts: steps, rejected steps, evaluations, Jacobians, and whether the case is stiff, shape (k, 5).
        findings: what a user should know of each case.
        outputs: the values of the outputs, shape (k, outputs, N).
        states: the states, shape (k, N, n); shape (k, 0, n) if they are not kept.
        slopes: the derivatives of the states by p parameters and initial values, shape (k, N, n, p).
        occurrences: the events of each case: which one, the instant, the state there, and its derivatives, (n, p); and
            all of them as a table.
    """

    status: NDArray[np.int8]
    reached: NDArray[np.int64]
    t_reached: Array
    messages: NDArray[np.object_]
    counts: NDArray[np.int64]
    findings: NDArray[np.object_]
    outputs: Array
    states: Array
    slopes: Array
    occurrences: CaseEvents

    @classmethod
    def empty(
        cls, cases: int, instants: int, kept: int, state: int, outputs: int, slopes: tuple[int, int] = (0, 0)
    ) -> Results:
        """Return the results of cases that were not run.

        Args:
            cases: the number of cases, k.
            instants: the number of instants, N.
            kept: the number of instants whose states are kept: N or 0.
            state: the length of a state and the work.
            outputs: the number of outputs.
            slopes: the shape of the derivatives of a state, (n, p).
        """
        return cls(
            np.zeros(cases, dtype=np.int8),
            np.zeros(cases, dtype=np.int64),
            np.full(cases, np.nan),
            np.full(cases, "", dtype=object),
            np.zeros((cases, COUNTS), dtype=np.int64),
            _empty_tuples(cases),
            np.full((cases, outputs, instants), np.nan),
            np.full((cases, kept, state), np.nan),
            np.full((cases, kept if slopes[1] else 0, *slopes), np.nan),
            CaseEvents(cases, state, slopes),
        )

    @property
    def missing(self) -> NDArray[np.intp]:
        """The cases that were not run."""
        return np.flatnonzero(self.status == Status.NOT_RUN)

    def put(self, cases: NDArray[np.intp], part: Results) -> None:
        """Store the results of some cases."""
        for name in _COLUMNS:
            getattr(self, name)[cases] = getattr(part, name)
        self.occurrences.add(part.occurrences.table.renumbered(cases))

    def cut(self, start: int, stop: int) -> Results:
        """Return the results of successive cases, as those of a batch of their own."""
        events = self.occurrences.table
        own = slice(*np.searchsorted(events.case, (start, stop)).tolist())
        _, width = events.state.shape
        _, n, by = events.slopes.shape
        occurrences = CaseEvents(stop - start, width, (n, by))
        part = Occurrences(
            events.case[own] - start, events.event[own], events.t[own], events.state[own], events.slopes[own]
        )
        occurrences.add(part)
        rows = {name: getattr(self, name)[start:stop] for name in _COLUMNS}
        return Results(**rows, occurrences=occurrences)

    def arrays(self) -> dict[str, NDArray[Any]]:
        """Return all results as arrays of numbers and texts, for a file."""
        events = self.occurrences.table
        found_in, findings = _flat(self.findings)
        return {
            "status": self.status,
            "reached": self.reached,
            "t_reached": self.t_reached,
            "messages": self.messages.astype(np.str_),
            "counts": self.counts,
            "outputs": self.outputs,
            "states": self.states,
            "slopes": self.slopes,
            "finding_case": found_in,
            "finding_kind": np.array([finding.kind for finding in findings], dtype=np.str_),
            "finding_subject": np.array([finding.subject for finding in findings], dtype=np.str_),
            "finding_size": np.array([finding.size for finding in findings], dtype=np.float64),
            "event_case": events.case,
            "event_number": events.event,
            "event_t": events.t,
            "event_state": events.state,
            "event_slopes": events.slopes,
        }

    @classmethod
    def of_arrays(cls, arrays: Mapping[str, NDArray[Any]]) -> Results:
        """Return the results that `arrays` describes."""
        cases = len(arrays["status"])
        findings = _empty_tuples(cases)
        case, event, t, state, slopes = (
            arrays[f"event_{name}"] for name in ("case", "number", "t", "state", "slopes")
        )
        width = max(state.shape[1], arrays["states"].shape[2])
        if width > state.shape[1]:  # a file from before the work was kept
            state = np.pad(state, ((0, 0), (0, width - state.shape[1])), constant_values=np.nan)
        occurrences = CaseEvents(cases, width, (slopes.shape[1], slopes.shape[2]))
        occurrences.add(Occurrences(case, event, t, state, slopes))
        for case, kind, subject, size in _rows(arrays, "finding", "case", "kind", "subject", "size"):
            findings[case] += (Finding(str(kind), str(subject), float(size)),)
        texts = arrays["messages"].astype(object)
        columns = {name: arrays[name] for name in _COLUMNS if name in arrays and name != "messages"}
        return cls(**columns, messages=texts, occurrences=occurrences, findings=findings)


def _empty_tuples(cases: int) -> NDArray[np.object_]:
    """Return an empty tuple for each case."""
    column = np.empty(cases, dtype=object)
    column[:] = [()] * cases
    return column


def _flat(column: NDArray[np.object_]) -> tuple[NDArray[np.int64], list[Any]]:
    """Return all entries of the tuples of a column, one after another, and the case of each."""
    cases = [case for case, entries in enumerate(column) for _ in entries]
    return np.array(cases, dtype=np.int64), [entry for entries in column for entry in entries]


def _rows(arrays: Mapping[str, NDArray[Any]], what: str, *names: str) -> Iterable[tuple[Any, ...]]:
    return zip(*(arrays[f"{what}_{name}"] for name in names), strict=True)


COUNTS = 5
"""The number of statistics of a case: steps, rejected, evaluations, Jacobians, stiff."""

_COLUMNS = (
    "reached",
    "t_reached",
    "messages",
    "counts",
    "findings",
    "outputs",
    "states",
    "slopes",
    "status",
)
