"""Chunks in flight: they run in threads of this process or by an executor, a bounded number at a time."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import Executor, Future
from time import monotonic

import numpy as np

from symbody.simulation.batch.cases import Cases
from symbody.simulation.batch.in_flight import INTERRUPTED, InFlight
from symbody.simulation.batch.parcel import Parcel
from symbody.simulation.batch.run_cases import run_cases
from symbody.simulation.batch.stop_flag import StopFlag
from symbody.simulation.batch.workers import cases_in_memory, counting_from
from symbody.simulation.terminal.interruption import Interruption

from .chunk import Chunk, run_chunk, summed_up
from .plan import PLACE, Plan

__all__ = ["Finished", "run_by_executor", "run_in_threads"]

Finished = tuple[int, Chunk]
"""The number of a chunk, and its results."""

KeepGoing = Callable[[float], bool]


TOGETHER, SPAN = 4096, 0.5
"""The most cases of chunks that threads run together, and about how long they may take, in s: Ctrl-C loses these."""


def chunk_of(cases: Cases, number: int, size: int) -> Cases:
    """Return the cases of a chunk."""
    return cases.subset(np.arange(number * size, min(cases.count, (number + 1) * size)))


def run_in_threads(
    plan: Plan, cases: Cases, size: int, numbers: Iterable[int], threads: int, keep_going: KeepGoing
) -> Iterator[Finished]:
    """Run chunks in native threads. Those of short motions run together, so that less time is lost between them.

    Args:
        plan: what the cases share.
        cases: all cases.
        size: the number of cases of a chunk.
        numbers: the chunks to run.
        threads: the number of threads.
        keep_going: called some times a second with the number of finished cases; False ends the chunks in progress.
    """
    most = max(1, min(TOGETHER, cases_in_memory(plan.task)) // size)
    waiting, count, done = deque(numbers), 1, 0
    while waiting and keep_going(done):
        together, begin = _successive(waiting, count), monotonic()
        first, end = together.start * size, min(cases.count, together.stop * size)
        own = cases.subset(np.arange(first, end))
        results = run_cases(plan.task, own, threads, counting_from(keep_going, done))
        for number in together:
            start, stop = number * size - first, min(own.count, (number + 1) * size - first)
            part = own.subset(np.arange(start, stop))
            chunk = summed_up(plan, part, number * size, results.cut(start, stop))
            if chunk is not None:
                yield number, chunk
        if len(results.missing):
            return
        done += own.count
        count = int(np.clip(count * SPAN / max(monotonic() - begin, 1e-9), 1, min(most, 4 * count)))


def _successive(waiting: deque[int], most: int) -> range:
    """Take the first of some numbers and those that follow it without a gap, as drawn cases do."""
    first = last = waiting.popleft()
    while waiting and waiting[0] == last + 1 and last + 1 - first < most:
        last = waiting.popleft()
    return range(first, last + 1)


def run_by_executor(
    plan: Plan,
    cases: Cases,
    size: int,
    numbers: Iterable[int],
    executor: Executor,
    most: int,
    oldest: Callable[[], int],
    keep_going: KeepGoing,
) -> Iterator[Finished]:
    """Run chunks as tasks of an executor, and yield them as they are finished.

    Args:
        plan: what the cases share.
        cases: all cases.
        size: the number of cases of a chunk.
        numbers: the chunks to run, in order.
        executor: the executor.
        most: the most chunks in flight, and the most by which one may be ahead of the oldest one.
        oldest: returns the first chunk that is still awaited.
        keep_going: called some times a second with the number of finished cases; False ends all of them.

    Raises:
        SimulationError: the executor is broken, or its workers lost a chunk for good.
    """
    parcel, flag, done = Parcel(plan), StopFlag(), 0

    def begin(number: int) -> Future[Chunk | None]:
        return executor.submit(_run, parcel, chunk_of(cases, number, size), number * size, flag)

    def goes_on() -> bool:
        return keep_going(done)

    def may_begin(number: int) -> bool:
        return number <= oldest() + most

    flight = InFlight(PLACE, executor, begin, most, flag)
    with parcel.open_here():
        for number, chunk in flight.results(numbers, goes_on, may_begin):
            if chunk is None:
                flight.lost = INTERRUPTED
            else:
                done += len(chunk.status)
                yield number, chunk


def _run(parcel: Parcel[Plan], cases: Cases, first: int, flag: StopFlag) -> Chunk | None:
    """Run a chunk in a worker, until the study is over or the worker receives Ctrl-C."""
    if flag.is_set():
        return None
    if flag.is_of_this_process():
        return run_chunk(parcel.content, cases, first, 1, lambda _: not flag.is_set())
    with Interruption() as interruption:
        return run_chunk(
            parcel.content, cases, first, 1, lambda _: not (interruption.is_asked_for or flag.is_set())
        )
