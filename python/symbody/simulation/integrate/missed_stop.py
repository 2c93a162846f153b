"""Stops that a motion passed unseen: it came back within a part of one step."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from symbody.simulation.given.watched_limit import LIMIT

from .integrated import Integrated
from .stopped_start import stops_of

__all__ = ["step_to_missed_stop"]

Array = NDArray[np.float64]


def step_to_missed_stop(motion: Integrated) -> float | None:
    """Return the longest step with which a motion meets the stops that it passed unseen, in s; None if it passed none.

    Events are changes of sign between the tenths of a step, so that the longest step is the shortest excursion.
    """
    states = np.array(motion.outcome.states)
    if motion.outcome.failure is not None or len(states) < 2:
        return None
    return min(_excursions(motion, states), default=None)


def _excursions(motion: Integrated, states: Array) -> Iterator[float]:
    """Yield how long a joint is beyond a stop, in s, for each time that it comes from within its limits."""
    task, size = motion.task, len(motion.task.model.state)
    t, largest = task.instants[: len(states)], np.abs(states[:, : len(task.model.coordinates)]).max(axis=1)
    for event, _ in stops_of(task):
        (excess,) = task.values([event.expression], states[:, :size], t, motion.parameters)
        beyond = excess > LIMIT * (1 + largest)
        for first in np.flatnonzero(beyond[1:] & ~beyond[:-1]) + 1:
            back = np.flatnonzero(~beyond[first:])
            last = first + back[0] if len(back) else len(t) - 1
            yield float(t[last] - t[first - 1])
