"""The outcomes of many motions: numbers in columns, from which the outcome of one is made when it is asked for."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, overload

import numpy as np
from numpy.typing import NDArray

from .occurrences import Occurrences
from .outcome import Outcome, Statistics

__all__ = ["Outcomes"]

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Outcomes(Sequence[Outcome | None]):
    """The outcomes of k motions. Most have reached the last instant, or a terminal event, with nothing else to tell.

    Attributes:
        states: the states of all motions at the N instants, shape (k, N, width).
        counts: steps, rejected steps, evaluations, Jacobians, and whether the motion is stiff, shape (k, 5); -1 for
            motions that were not started.
        reached: the number of instants that each motion reached, shape (k,).
        end_t: the instant at which each motion ended, shape (k,).
        occurrences: the events of the motions that are not remarkable.
        remarkable: the outcomes of motions that ended early without an event, or of which there is something to tell.
    """

    states: Array
    counts: NDArray[np.int64]
    reached: NDArray[np.int64]
    end_t: Array
    occurrences: Occurrences
    remarkable: Mapping[int, Outcome] = field(default_factory=dict)

    def __len__(self) -> int:
        return len(self.states)

    @property
    def plain(self) -> NDArray[np.bool_]:
        """Which motions have nothing to tell but their costs and events, shape (k,)."""
        plain: NDArray[np.bool_] = self.counts[:, 0] >= 0
        plain[list(self.remarkable)] = False
        return plain

    @property
    def is_whole(self) -> NDArray[np.bool_]:
        """Which motions reached the last instant, shape (k,); a plain motion that did not ended at an event."""
        whole: NDArray[np.bool_] = self.reached == self.states.shape[1]
        return whole

    @property
    def ends(self) -> Array:
        """The states where plain motions ended, shape (k, width)."""
        ends = self.states[:, -1].copy()
        early = np.flatnonzero(self.plain & ~self.is_whole)
        ends[early] = self.occurrences.state[self.occurrences.last(early)]
        return ends

    @overload
    def __getitem__(self, place: int) -> Outcome | None: ...
    @overload
    def __getitem__(self, place: slice) -> Sequence[Outcome | None]: ...
    def __getitem__(self, place: Any) -> Any:
        """Return the outcome of a motion; None if it was not started."""
        if isinstance(place, slice):
            return [self[k] for k in range(*place.indices(len(self)))]
        if place in self.remarkable:
            return self.remarkable[place]
        steps, rejected, evaluations, jacobians, is_stiff = self.counts[place].tolist()
        if steps < 0:
            return None
        states = self.states[place, : self.reached[place]]
        statistics = Statistics(steps, rejected, evaluations, jacobians, bool(is_stiff))
        occurrences = [(event, t, state.tolist()) for event, t, state, _ in self.occurrences.of(place)]
        is_whole = self.reached[place] == self.states.shape[1]
        end = (float(self.end_t[place]), states[-1].tolist()) if is_whole else occurrences[-1][1:]
        return Outcome(states, occurrences, end, None, statistics)
