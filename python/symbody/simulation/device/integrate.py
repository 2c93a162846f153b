"""Integrates the motions of a task on its device; those in trouble are integrated by the host."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import cache, partial

import numpy as np
from numpy.typing import NDArray

from symbody.simulation.integrate.occurrences import Occurrences
from symbody.simulation.integrate.outcome import Outcome
from symbody.simulation.integrate.outcomes import Outcomes
from symbody.simulation.integrate.task import Columns, Integrate, KeepGoing, Method, Task

from .device import Device, Loaded
from .endings import REASONS, Column, Ending, Endings
from .kernel_text import Kernel
from .run_kernel import run_kernel

__all__ = ["Prepared", "method_on_device"]

Array = NDArray[np.float64]
Prepared = tuple[Device, Kernel, Loaded]
"""A device, and a kernel there."""


def method_on_device(method: Method, prepared: Callable[[Task], Prepared]) -> Method:
    """Return a method that runs on a device.

    Args:
        method: the same method on the host.
        prepared: returns the device of a task, and its kernel there.
    """
    return replace(method, prepare=partial(_prepare, host=method.prepare, prepared=prepared))


def _prepare(
    task: Task, host: Callable[[Task], Integrate], prepared: Callable[[Task], Prepared]
) -> Integrate:
    prepared(task)
    return partial(_integrate, task, prepared, cache(lambda: host(task)))


def _integrate(
    task: Task,
    prepared: Callable[[Task], Prepared],
    host: Callable[[], Integrate],
    parameters: Columns,
    states: Array,
    threads: int,
    keep_going: KeepGoing,
) -> Outcomes:
    """Integrate motions, most of them on the device.

    Args:
        task: what they share.
        prepared: returns the device, and the kernel there.
        host: returns the function that integrates motions on the host.
        parameters: values by name, one for each of the k motions.
        states: the initial states, shape (k, width).
        threads: how many motions the host integrates at a time.
        keep_going: see `KeepGoing`; False ends all of them.
    """
    device, kernel, loaded = prepared(task)
    rows = np.empty((len(states), len(kernel.parameters)))
    for place, name in enumerate(kernel.parameters):
        rows[:, place] = parameters[name]
    found = run_kernel(device, loaded, kernel, task.options, task.instants, rows, states, keep_going)
    counts = np.full((len(states), 5), -1)
    over = found.is_over
    counts[over, :3] = found.counts[over, Column.STEPS : Column.EVALUATIONS + 1]
    counts[over, 3:] = np.column_stack([np.zeros(over.sum()), found.counts[over, Column.STIFF]])
    remarkable: dict[int, Outcome] = {}
    left = np.flatnonzero(found.is_left)
    if len(left):
        own = {name: values[left] for name, values in parameters.items()}
        done = int(over.sum())
        outcomes = host()(own, states[left], threads, lambda more: keep_going(done + more))
        for k, outcome in zip(left.tolist(), outcomes, strict=True):
            if outcome is not None:
                remarkable[k] = replace(outcome, left=REASONS[Ending(int(found.status[k]))])
    reached = found.counts[:, Column.REACHED]
    events = _occurrences(found, over)
    ends = np.full(len(states), float(task.instants[-1]))
    early = np.flatnonzero(found.status == Ending.ENDED_BY_EVENT)
    ends[early] = events.t[events.last(early)]
    found.states[early] = np.where(  # what follows is not part of the motions
        np.arange(len(task.instants))[:, np.newaxis] < reached[early, np.newaxis, np.newaxis],
        found.states[early],
        np.nan,
    )
    return Outcomes(found.states, counts, reached, ends, events, remarkable)


def _occurrences(found: Endings, over: NDArray[np.bool_]) -> Occurrences:
    """Return the events of motions that are over."""
    most, size = found.events.shape[1], found.events.shape[2] - 2
    happened = np.arange(most) < np.where(over, found.counts[:, Column.HAPPENED], 0)[:, np.newaxis]
    case, place = np.nonzero(happened)
    rows = found.events[case, place]
    return Occurrences(
        case, rows[:, 0].astype(np.int64), rows[:, 1], rows[:, 2:], np.empty((len(case), size, 0))
    )
