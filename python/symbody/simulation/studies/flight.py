"""Chunks in flight: they run in threads of this process or by an executor, a bounded number at a time."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import Executor, Future

import numpy as np

from symbody.simulation.batch.cases import Cases
from symbody.simulation.batch.in_flight import INTERRUPTED, InFlight
from symbody.simulation.batch.parcel import Parcel
from symbody.simulation.batch.stop_flag import StopFlag
from symbody.simulation.batch.workers import counting_from
from symbody.simulation.terminal.interruption import Interruption

from .chunk import Chunk, run_chunk
from .plan import PLACE, Plan

__all__ = ["Finished", "run_by_executor", "run_in_threads"]

Finished = tuple[int, Chunk]
"""The number of a chunk, and its results."""

KeepGoing = Callable[[float], bool]


def chunk_of(cases: Cases, number: int, size: int) -> Cases:
    """Return the cases of a chunk."""
    return cases.subset(np.arange(number * size, min(cases.count, (number + 1) * size)))


def run_in_threads(
    plan: Plan, cases: Cases, size: int, numbers: Iterable[int], threads: int, keep_going: KeepGoing
) -> Iterator[Finished]:
    """Run chunks one after another, each in native threads.

    Args:
        plan: what the cases share.
        cases: all cases.
        size: the number of cases of a chunk.
        numbers: the chunks to run.
        threads: the number of threads.
        keep_going: called some times a second with the number of finished cases; False ends the chunk in progress.
    """
    done = 0
    for number in numbers:
        if not keep_going(done):
            return
        part = chunk_of(cases, number, size)
        chunk = run_chunk(plan, part, number * size, threads, counting_from(keep_going, done))
        if chunk is None:
            return
        done += part.count
        yield number, chunk


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
