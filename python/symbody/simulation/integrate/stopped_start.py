"""Starts that a stop forbids: a joint is at its limit, or beyond it, and moves outwards.

A stop is an event, and an event is a passage through zero, which such a motion has behind it.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import numpy as np
from numpy.typing import NDArray

from symbody.simulation.given.event import Event
from symbody.simulation.given.watched_limit import watched_limits
from symbody.symbolic import Expr, time_derivative

from .task import Columns, Task

__all__ = ["stopped_start", "stopped_starts", "stops_of"]

Array = NDArray[np.float64]

_AT_REST = 1e-9
"""The rate, relative to the largest one, up to which a joint at its limit is at rest: its acceleration counts."""


def stopped_start(task: Task, parameters: Mapping[Expr, float], state: Array) -> str:
    """Return why a stop of a task forbids an initial state; empty if none does.

    Args:
        task: the task.
        parameters: the values of the parameters.
        state: the initial state, shape (model.width,).
    """
    columns = {name: np.array([value]) for name, value in parameters.items()}
    return stopped_starts(task, columns, state[np.newaxis]).get(0, "")


def stopped_starts(task: Task, parameters: Columns, states: Array) -> dict[int, str]:
    """Return why stops of a task forbid initial states, by the number of the motion.

    Args:
        task: the task.
        parameters: the values of the parameters, one for each of the k motions.
        states: the initial states, shape (k, model.width).
    """
    found: dict[int, str] = {}
    for event, joint in stops_of(task):
        excess = _values(task, event.expression, parameters, states)
        for case in np.flatnonzero(excess >= 0).tolist():
            own = {name: column[case : case + 1] for name, column in parameters.items()}
            course = _outward_course(task, event, own, states[case])
            if course and case not in found:
                place = f"{excess[case]:.3g} beyond" if excess[case] > 0 else "at"
                found[case] = (
                    f"simulate, events: {joint} begins {place} its limit at t = {task.instants[0]:.6g} s, and "
                    f"{course}, so that the stop {event} never ends the motion; expected a start within the limits, "
                    "or a velocity inwards; to model what happens at a stop, use a load"
                )
    return found


def stops_of(task: Task) -> Iterator[tuple[Event, str]]:
    """Yield the events that are stops, with their joints: they rise through the excess over a limit, and end there."""
    limits = {
        excess: watched.joint
        for watched in (watched_limits(task.model.system, tuple) if task.events else ())
        for excess in watched.excess
    }
    for event in task.events:
        if event.terminal and event.direction == 1 and event.expression in limits:
            yield event, limits[event.expression]


def _outward_course(task: Task, event: Event, parameters: Columns, state: Array) -> str:
    """Return how a joint moves outwards, in words; empty if it moves inwards, or rests and isn't pushed."""
    at, model = state[np.newaxis], task.model
    rate = time_derivative(event.expression)
    speed = _values(task, rate, parameters, at)[0]
    if abs(speed) > _AT_REST * (1 + np.max(np.abs(state[: len(model.state)]))):
        return f"moves outwards at {speed:.3g} per s" if speed > 0 else ""
    push = _values(task, time_derivative(rate), parameters, at)[0]
    return f"is at rest, but accelerated outwards at {push:.3g} per s^2" if push > _AT_REST else ""


def _values(task: Task, expression: Expr, parameters: Columns, states: Array) -> Array:
    """Return the values of an expression at the initial states, shape (k,)."""
    function = task.model.function([expression], tuple(parameters))
    start = np.full(len(states), task.instants[0])
    variables = states[:, : len(task.model.state)].T
    return np.asarray(function(start, *variables, *parameters.values()), dtype=float).reshape(-1)
