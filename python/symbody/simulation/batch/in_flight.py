"""Tasks in flight: at the workers of an executor, a bounded number at a time, and again if a worker loses them."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import (
    FIRST_COMPLETED,
    BrokenExecutor,
    CancelledError,
    Executor,
    Future,
    ProcessPoolExecutor,
    wait,
)
from dataclasses import dataclass, field
from typing import Generic, TypeVar

from symbody.errors import SimulationError, SymbodyError

from .stop_flag import StopFlag

__all__ = ["INTERRUPTED", "InFlight"]

Result = TypeVar("Result")

TRIES = 3
"""How often a task is given to an executor whose workers lose it."""

LOOK = 0.1
"""The time between two checks for Ctrl-C, in s."""

CANCELLED = CancelledError("somebody else cancelled a task")
"""What a task has met that neither ran nor was withdrawn."""

INTERRUPTED = KeyboardInterrupt("a worker was interrupted")
"""What a task that was not finished has met."""


@dataclass(eq=False)
class InFlight(Generic[Result]):
    """The tasks of a call that an executor runs. A task that is lost for good does not stop the others.

    Attributes:
        place: the function that the user called, for messages.
        executor: the executor.
        begin: submits the task of a number.
        most: the most tasks in flight.
        flag: the flag that stops tasks that have begun.
        lost: why tasks were lost for good, if any were.
    """

    place: str
    executor: Executor
    begin: Callable[[int], Future[Result]]
    most: int
    flag: StopFlag
    lost: BaseException | None = None
    _waiting: dict[Future[Result], int] = field(default_factory=dict)
    _tries: dict[int, int] = field(default_factory=dict)
    _queue: list[int] = field(default_factory=list)

    def results(
        self,
        numbers: Iterable[int],
        keep_going: Callable[[], bool],
        may_begin: Callable[[int], bool] = lambda _: True,
    ) -> Iterator[tuple[int, Result]]:
        """Yield the results of tasks as they are finished, with their numbers.

        Args:
            numbers: the tasks, in the order in which they begin.
            keep_going: called some times a second; False ends all of them.
            may_begin: whether a task may begin now; asked of the next one.

        Raises:
            SimulationError: tasks were lost for good; all others were yielded before.
        """
        self._queue = [*numbers][::-1]
        try:
            while keep_going() and self._are_begun(may_begin):
                yield from self._landed()
        finally:
            if self._waiting or self.lost is not None:
                self.flag.set()
                self._withdraw()
        if self.lost is not None and keep_going():
            raise self._error(self.lost) from self.lost

    def _are_begun(self, may_begin: Callable[[int], bool]) -> bool:
        """Submit as many tasks as there may be; return whether any is in flight."""
        while self._queue and len(self._waiting) < self.most and may_begin(self._queue[-1]):
            number = self._queue.pop()
            self._tries[number] = self._tries.get(number, 0) + 1
            try:
                self._waiting[self.begin(number)] = number
            except Exception as error:
                if self.lost is None and not self._waiting:
                    raise self._error(error) from error
                self.lost = self.lost or error
                self._queue.clear()
        return bool(self._waiting)

    def _landed(self) -> Iterator[tuple[int, Result]]:
        """Yield what has been finished; queue what was lost, unless that is for good."""
        ready, _ = wait(self._waiting, timeout=LOOK, return_when=FIRST_COMPLETED)
        # An executor that is shut down may cancel tasks without a word to those who wait for them.
        ready |= {future for future in self._waiting if future.cancelled()}
        for future in sorted(ready, key=lambda one: self._waiting[one]):
            number = self._waiting.pop(future)
            error = CANCELLED if future.cancelled() else future.exception()
            if error is None:
                yield number, future.result()
            elif isinstance(error, BrokenExecutor):
                self.lost = error
                self._queue.clear()
            elif isinstance(error, SymbodyError) or self._tries[number] >= TRIES:
                self.lost = error
            else:
                self._queue.append(number)

    def _withdraw(self) -> None:
        """Cancel tasks, except those of a process pool: these see the flag and end when they start.

        If a worker dies after tasks were cancelled, such a pool fails on them and never ends its other workers (Python
        3.11, its issue 107219). Nor does it end a worker that starts while another one dies, as Ctrl-C makes it: that
        worker would wait for tasks, and this process for the worker.
        """
        if not isinstance(self.executor, ProcessPoolExecutor):
            for future in self._waiting:
                future.cancel()
        elif isinstance(self.lost, BrokenExecutor):
            workers = self.executor._processes or {}  # noqa: SLF001  there is no public list of them
            for worker in [*workers.values()]:
                worker.terminate()

    def _error(self, error: BaseException) -> SimulationError:
        return SimulationError(
            f"{self.place}: tasks of the executor failed ({type(error).__name__}: {error}); expected an executor whose "
            "workers can import symbody and keep running"
        )
