"""A study in progress: its chunks, the workers that run them, and what is taken from them."""

from __future__ import annotations

from collections.abc import Iterator
from concurrent.futures import Executor
from dataclasses import dataclass

import numpy as np

from symbody.errors import ArgumentError, SimulationError
from symbody.simulation.batch.cases import Cases
from symbody.simulation.batch.workers import MEMORY, cases_in_memory
from symbody.simulation.terminal.interruption import Interruption
from symbody.simulation.terminal.progress import progress_bar
from symbody.symbolic.given.arguments import described

from .accumulation import Accumulation
from .flight import Finished, run_by_executor, run_in_threads
from .plan import PLACE, Plan

__all__ = ["StudyRun", "chunk_size"]

FEWEST, MOST, CHUNKS = 256, 4096, 64
"""The least cases of a chunk (enough for lock-step), the most (to lose), and in between the number of chunks."""

MOST_ON_DEVICE = 2**17
"""The most cases of a chunk on a device, whose many threads all need a motion."""

IN_FLIGHT = 256 * 2**20
"""The bytes of results that are at the workers of an executor, or on their way."""


@dataclass(frozen=True, eq=False)
class StudyRun:
    """A study in progress."""

    plan: Plan
    cases: Cases
    found: Accumulation

    def run_missing(self, executor: Executor | None, threads: int, *, progress: bool | None) -> str:
        """Run the missing chunks; return why some of them were not run."""
        found, finished = self.found, self.found.done
        with (
            Interruption() as interruption,
            progress_bar(PLACE, self.cases.count, is_shown=progress) as show,
        ):

            def keep_going(done: float) -> bool:
                show(finished + done)
                return not interruption.is_asked_for

            numbers, size = found.missing, found.size
            if executor is None:
                parts = run_in_threads(self.plan, self.cases, size, numbers, threads, keep_going)
            else:
                parts = run_by_executor(
                    self.plan,
                    self.cases,
                    size,
                    numbers,
                    executor,
                    self._most_in_flight(),
                    found.oldest,
                    keep_going,
                )
            reason = self._take(parts)
            show(found.done)
        return "interrupted" if interruption.is_asked_for else reason

    def _most_in_flight(self) -> int:
        """Return how many chunks may be at the workers."""
        plan = self.plan
        over_time, size = len(plan.outputs) * len(plan.task.instants), self.found.size
        numbers = size * (len(plan.columns) + over_time * plan.keeps_histories)
        numbers += over_time * sum(statistic.numbers for statistic in plan.statistics)
        return int(np.clip(IN_FLIGHT // (8 * max(1, numbers)), 4, 1024))

    def _take(self, parts: Iterator[Finished]) -> str:
        """Take all chunks; if the executor fails, keep those that are there."""
        found = self.found
        try:
            for number, chunk in parts:
                found.put(number, chunk)
        except SimulationError as error:
            if not found.done:
                raise
            return str(error)
        finally:
            found.commit()
        if found.file is not None and not found.missing and not found.file.is_finished:
            found.file.finish(found.over_time(), found.tally.notices(found.count, PLACE))
        return ""


def chunk_size(plan: Plan, count: int, given: object) -> int:
    """Return the number of cases of a chunk: it depends on the study alone, as merging in chunks does.

    Args:
        plan: what is computed of each case.
        count: the number of cases.
        given: what the user asks for; None for the usual number.

    Raises:
        ArgumentError: it is no number.
    """
    if given is not None:
        if isinstance(given, bool) or not isinstance(given, int) or given < 1:
            raise ArgumentError(f"{PLACE}: chunk={described(given)}; expected a whole number from 1")
        return given
    task = plan.task
    if task.device is not None:
        return max(1, min(count, MOST_ON_DEVICE, cases_in_memory(task)))
    numbers = (len(task.instants) + task.trail) * (task.model.width + len(plan.expressions))
    size = int(np.clip(-(-count // CHUNKS), FEWEST, MOST))
    return max(1, min(size, MEMORY // (8 * numbers)))
