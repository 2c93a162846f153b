"""A motion, of what the integrator gave."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from symbody.symbolic import Expr

from .event import Event, Occurrence
from .integrator import Outcome
from .model import Model
from .motion import Motion

__all__ = ["motion_of"]


def motion_of(
    model: Model,
    parameters: Mapping[Expr, float],
    instants: NDArray[np.float64],
    events: Sequence[Event],
    outcome: Outcome,
    message: str,
    asked: Mapping[str, Expr],
) -> Motion:
    """Return the states at the instants that were reached, and at the end where it lies behind them.

    Args:
        model: what moves.
        parameters: the values of the parameters.
        instants: those that were asked for.
        events: what was looked for.
        outcome: how the integration went.
        message: why it ended, unless an event ended it.
        asked: expressions to evaluate, by name.
    """
    size, t, states = len(model.state), instants[: len(outcome.states)], outcome.states
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
        parameters,
        t,
        states[:, :size],
        work,
        happened,
        outcome.statistics,
        outcome.failure is None,
        message,
        asked,
    )
