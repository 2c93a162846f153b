"""The workers of a batch: native threads of this process, or the workers of an executor."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from concurrent.futures import Executor, Future
from math import inf
from os import PathLike
from time import monotonic

import numpy as np
from numpy.typing import NDArray

from symbody.errors import ArgumentError, SimulationError
from symbody.simulation.batch.case_arrays import Results
from symbody.simulation.device.devices import prepared
from symbody.simulation.device.run_kernel import bytes_of_case
from symbody.simulation.integrate.task import Task
from symbody.simulation.terminal.interruption import Interruption
from symbody.symbolic.given.arguments import described

from .cases import PLACE, Cases
from .in_flight import INTERRUPTED, InFlight
from .parcel import Parcel
from .run_cases import empty_results, run_cases
from .stop_flag import StopFlag

Part = tuple[NDArray[np.intp], Results]
"""The indices of some cases, and their results."""

MEMORY = 64 * 2**20
"""The bytes of states that are computed at a time in this process, or in a task."""

DEVICE_MEMORY = 512 * 2**20
"""The same on a device, whose many threads all need a motion."""

TASKS = 200
"""The number of tasks in a batch: many, for workers of unequal speed, but few to send."""

IN_FLIGHT = 64
"""The most tasks at the workers of an executor, or on their way."""

_interrupted: set[StopFlag] = set()
"""The calls whose tasks stop in this process only, because it received Ctrl-C."""


def core_count() -> int:
    """Return the number of processors that this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def checked_workforce(
    place: str, executor: object, threads: object, path: object, example: str = "runs.npz"
) -> tuple[Executor | None, int]:
    """Return the executor, and the number of threads without one.

    Args:
        place: the function that the user called.
        executor: the executor.
        threads: the number of threads.
        path: the path of a file for the results.
        example: the name of such a file, for messages.

    Raises:
        ArgumentError: one of them has the wrong kind.
    """
    if not isinstance(executor, Executor | None):
        raise ArgumentError(
            f"{place}: executor={described(executor)}; expected an executor of concurrent.futures, such as "
            "ProcessPoolExecutor(), dask's client.get_executor(), or None for threads of this process"
        )
    if not isinstance(path, str | PathLike | None):
        raise ArgumentError(f"{place}: path={described(path)}; expected a path, such as {example!r}")
    if isinstance(threads, bool) or not isinstance(threads, int) or threads < 1:
        raise ArgumentError(f"{place}: threads={described(threads)}; expected a whole number from 1")
    return executor, threads


def check_one_workforce(executor: object, device: object, place: str) -> None:
    """Check that motions are given to an executor or to a device, not to both.

    Raises:
        SimulationError: both are given.
    """
    if device is not None and executor is not None:
        raise SimulationError(
            f"{place}: device={device!r} and an executor; give one of them: the device is fed by this process"
        )


def run_in_threads(
    task: Task,
    cases: Cases,
    indices: NDArray[np.intp],
    threads: int,
    keep_going: Callable[[float], bool],
    span: float = inf,
) -> Iterator[Part]:
    """Run cases in native threads, part by part.

    Args:
        task: what the cases share.
        cases: all of them.
        indices: those to run.
        threads: how many run at a time.
        keep_going: called some times a second with the number of finished cases; False ends all of them.
        span: the longest time for a part, in s; a part has at least as many cases as there are threads.
    """
    most = max(threads, cases_in_memory(task))
    size, done = most if span == inf or task.device is not None else min(most, 4 * threads), 0
    while done < len(indices) and keep_going(done):
        chosen, begin = indices[done : done + size], monotonic()
        yield chosen, run_cases(task, cases.subset(chosen), threads, counting_from(keep_going, done))
        done += len(chosen)
        pace = span / max(monotonic() - begin, 1e-9)
        size = int(np.clip(size * pace, max(threads, size // 4), min(most, 4 * size)))


def counting_from(keep_going: Callable[[float], bool], past: int) -> Callable[[float], bool]:
    """Return a `keep_going` that adds the number of cases that are done already."""
    return lambda done: keep_going(past + done)


def run_by_executor(
    task: Task,
    cases: Cases,
    indices: NDArray[np.intp],
    executor: Executor,
    keep_going: Callable[[float], bool],
) -> Iterator[Part]:
    """Run cases as tasks of an executor, and yield parts in the order in which they are finished.

    Args:
        task: what the cases share.
        cases: all of them.
        indices: those to run.
        executor: the executor.
        keep_going: called some times a second with the number of finished cases; False ends all of them.

    Raises:
        SimulationError: tasks were lost for good: the executor is broken, or a worker can't run the model.
    """
    size = min(cases_in_memory(task), -(-len(indices) // TASKS))
    parts = [indices[start : start + size] for start in range(0, len(indices), size)]
    parcel, flag, done = Parcel(task), StopFlag(), 0

    def begin(number: int) -> Future[Results]:
        return executor.submit(_run, parcel, cases.subset(parts[number]), flag)

    def goes_on() -> bool:
        return keep_going(done)

    flight = InFlight(PLACE, executor, begin, IN_FLIGHT, flag)
    with parcel.open_here():
        for number, part in flight.results(range(len(parts)), goes_on):
            done += len(parts[number])
            if len(part.missing):
                flight.lost = INTERRUPTED
            yield parts[number], part


def _run(parcel: Parcel[Task], cases: Cases, flag: StopFlag) -> Results:
    """Run some cases in a worker, until the call is over or the worker receives Ctrl-C.

    A terminal sends Ctrl-C to all processes that it started: so a pool ends without waiting for long motions.
    """
    if flag in _interrupted or flag.is_set():
        return empty_results(parcel.content, cases.count)
    if flag.is_of_this_process():
        return run_cases(parcel.content, cases, 1, lambda _: not flag.is_set())
    with Interruption() as interruption:
        results = run_cases(
            parcel.content, cases, 1, lambda _: not (interruption.is_asked_for or flag.is_set())
        )
    if interruption.is_asked_for:
        _interrupted.add(flag)
    return results


def cases_in_memory(task: Task) -> int:
    """Return how many cases fit into the memory for states, and for events on a device."""
    numbers = (len(task.instants) + task.trail) * task.model.width
    if task.device is None:
        return max(1, MEMORY // (8 * numbers))
    return max(1, DEVICE_MEMORY // bytes_of_case(prepared(task)[1], len(task.instants)))
