"""A motion from the outcome of an integration."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from symbody.simulation.integrate.integrated import Integrated
from symbody.simulation.integrate.outcome import Outcome

from .motion import Motion
from .occurrence import Occurrence

__all__ = ["motion_of"]

Array = NDArray[np.float64]


def motion_of(integrated: Integrated, message: str) -> Motion:
    """Return the motion, at the instants that it reached; its end is added if it lies after them.

    Args:
        integrated: the integrated motion.
        message: why it ended, unless an event ended it.
    """
    task, outcome = integrated.task, integrated.outcome
    model, events = task.model, task.events
    size, t, states = len(model.state), task.instants[: len(outcome.states)], outcome.states
    if outcome.end[0] > t[-1]:
        t, states = np.append(t, outcome.end[0]), np.vstack([states, outcome.end[1]])
    slopes, at_events = _slopes(outcome, len(t))
    happened = tuple(
        Occurrence(events[k], time, dict(zip(model.state, at, strict=False)), by_event)
        for (k, time, at), by_event in zip(outcome.occurrences, at_events, strict=True)
    )
    if outcome.failure is None and happened and happened[-1].event.terminal and happened[-1].t == t[-1]:
        message = f"the event {happened[-1].event} at t = {t[-1]:.9g} s"
    idle = np.zeros(len(t)) if model.power is None else np.full(len(t), np.nan)
    work = states[:, size] if states.shape[1] > size else idle
    return Motion(
        model,
        integrated.parameters,
        t,
        states[:, :size],
        work,
        happened,
        outcome.statistics,
        outcome.failure is None,
        message,
        task.outputs,
        task.by,
        slopes,
    )


def _slopes(outcome: Outcome, count: int) -> tuple[Array | None, Sequence[Array | None]]:
    """Return the sensitivities at as many instants, shape (count, n, k), and those at the events; None without any."""
    found, events = outcome.sensitivities, len(outcome.occurrences)
    if found is None:
        return None, [None] * events
    along = found.states[:count]
    if len(along) < count:
        along = np.concatenate([along, found.end[np.newaxis]])
    return along, [*found.occurrences[:events]]
