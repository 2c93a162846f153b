"""Chunks in flight: they run in threads of this process or by an executor, a bounded number at a time."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import FIRST_COMPLETED, BrokenExecutor, Executor, Future, wait
from dataclasses import dataclass, field

import numpy as np

from symbody.errors import SimulationError, SymbodyError
from symbody.simulation.batch.cases import Cases
from symbody.simulation.batch.parcel import Parcel
from symbody.simulation.batch.stop_flag import StopFlag
from symbody.simulation.batch.workers import counting_from, withdraw
from symbody.simulation.terminal.interruption import Interruption

from .chunk import Chunk, run_chunk
from .plan import PLACE, Plan

__all__ = ["Finished", "run_by_executor", "run_in_threads"]

Finished = tuple[int, Chunk]
"""The number of a chunk, and its results."""

TRIES = 3
"""How often a chunk is given to an executor whose workers lose it."""

LOOK = 0.1
"""The time between two checks for Ctrl-C, in s."""

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


@dataclass(eq=False)
class _Flight:
    """Chunks at the workers of an executor."""

    executor: Executor
    parcel: Parcel[Plan]
    cases: Cases
    size: int
    flag: StopFlag = field(default_factory=StopFlag)
    waiting: dict[Future[Chunk | None], int] = field(default_factory=dict)
    tries: dict[int, int] = field(default_factory=dict)

    def submit(self, number: int) -> None:
        self.tries[number] = self.tries.get(number, 0) + 1
        part = chunk_of(self.cases, number, self.size)
        try:
            future = self.executor.submit(_run, self.parcel, part, number * self.size, self.flag)
        except Exception as error:
            raise _lost(error) from error
        self.waiting[future] = number

    def landed(self) -> Iterator[Finished]:
        """Yield the chunks that have been finished; give those that workers lost to others."""
        ready, _ = wait(self.waiting, timeout=LOOK, return_when=FIRST_COMPLETED)
        for future in sorted(ready, key=lambda one: self.waiting[one]):
            number, error = self.waiting.pop(future), future.exception()
            if error is None:
                chunk = future.result()
                if chunk is None:
                    raise _lost(KeyboardInterrupt("a worker was interrupted"))
                yield number, chunk
            elif isinstance(error, BrokenExecutor | SymbodyError) or self.tries[number] >= TRIES:
                raise _lost(error) from error
            else:
                self.submit(number)


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
        SimulationError: the executor is broken, or its workers lost a chunk several times.
    """
    flight = _Flight(executor, Parcel(plan), cases, size)
    queue, done = list(numbers)[::-1], 0
    with flight.parcel.open_here():
        try:
            while (queue or flight.waiting) and keep_going(done):
                while queue and len(flight.waiting) < most and queue[-1] <= oldest() + most:
                    flight.submit(queue.pop())
                for number, chunk in flight.landed():
                    done += len(chunk.status)
                    yield number, chunk
        finally:
            if flight.waiting:
                flight.flag.set()
                withdraw(flight.waiting, executor)


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


def _lost(error: BaseException) -> SimulationError:
    return SimulationError(
        f"{PLACE}: tasks of the executor failed ({type(error).__name__}: {error}); expected an executor whose workers "
        "can import symbody and keep running"
    )
