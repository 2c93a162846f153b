"""The outcomes of many motions: numbers in columns, from which the outcome of one is made when it is asked for."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, overload

import numpy as np
from numpy.typing import NDArray

from .outcome import Outcome, Statistics

__all__ = ["Outcomes"]


@dataclass(frozen=True, eq=False)
class Outcomes(Sequence[Outcome | None]):
    """The outcomes of k motions. Most have reached the last instant, and there is nothing else to tell of them.

    Attributes:
        states: the states of all motions at the N instants, shape (k, N, width).
        end: the last instant, in s.
        counts: steps, rejected steps, evaluations, Jacobians, and whether the motion is stiff, shape (k, 5); -1 for
            motions that were not started.
        remarkable: the outcomes of motions that ended early, or of which there is something to tell.
    """

    states: NDArray[np.float64]
    end: float
    counts: NDArray[np.int64]
    remarkable: Mapping[int, Outcome] = field(default_factory=dict)

    def __len__(self) -> int:
        return len(self.states)

    @property
    def plain(self) -> NDArray[np.bool_]:
        """Which motions reached the last instant, with nothing to tell of them but the costs, shape (k,)."""
        plain: NDArray[np.bool_] = self.counts[:, 0] >= 0
        plain[list(self.remarkable)] = False
        return plain

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
        states = self.states[place]
        statistics = Statistics(steps, rejected, evaluations, jacobians, bool(is_stiff))
        return Outcome(states, [], (self.end, states[-1].tolist()), None, statistics)
