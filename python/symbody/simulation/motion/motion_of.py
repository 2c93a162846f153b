"""A motion from the outcome of an integration."""

from __future__ import annotations

import numpy as np

from symbody.simulation.integrate.integrated import Integrated

from .motion import Motion
from .occurrence import Occurrence

__all__ = ["motion_of"]


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
    happened = tuple(
        Occurrence(events[k], time, dict(zip(model.state, at, strict=False)))
        for k, time, at in outcome.occurrences
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
    )
