"""What is known of a study so far: chunks are put in as they come, and statistics are merged in their order."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from symbody.simulation.batch.case_arrays import Status
from symbody.simulation.integrate.tally import Tally

from .chunk import Chunk
from .plan import Plan
from .statistics.statistic import Partial
from .study_file import COMMIT, StudyFile

__all__ = ["Accumulation"]

Array = NDArray[np.float64]


@dataclass(eq=False)
class Accumulation:
    """The results of the chunks so far. Its memory is that of the measures, and of statistics of chunks in flight.

    Partial statistics are merged from the first chunk on, one after another, so that no digit depends on the order in
    which chunks are finished.

    Attributes:
        plan: what is computed.
        count: the number of cases.
        size: the number of cases of a chunk.
        file: where chunks are kept, if anywhere.
        status: how each case ended, shape (count,).
        t_reached: the last known instant of each case, shape (count,).
        values: the numbers of the measures by name, shape (count,) each.
        messages: why cases failed, by their number.
        merged: the statistics of the first `upto` chunks.
        upto: the number of these chunks.
        tally: the findings, counted.
    """

    plan: Plan
    count: int
    size: int
    file: StudyFile | None
    status: NDArray[np.int8]
    t_reached: Array
    values: dict[str, Array]
    messages: dict[int, str]
    merged: list[Partial]
    upto: int
    tally: Tally = field(default_factory=Tally)
    _ahead: dict[int, list[Partial]] = field(default_factory=dict)
    """The statistics of chunks that were finished before earlier ones."""
    _stored: int = 0

    @classmethod
    def begun(cls, plan: Plan, count: int, size: int, file: StudyFile | None) -> Accumulation:
        """Return what a file holds, or nothing yet."""
        if file is None:
            values = {name: np.full(count, np.nan) for name in plan.columns}
            status, t_reached = np.zeros(count, dtype=np.int8), np.full(count, np.nan)
            return cls(plan, count, size, None, status, t_reached, values, {}, [], 0)
        with file.reading():
            status, t_reached, values = file.read()
            messages = file.messages(np.flatnonzero(status == Status.FAILED))
            upto, merged = file.merged()
            made = cls(
                plan, count, size, file, status, t_reached, values, messages, merged, upto, _stored=upto
            )
            for number in range(made.chunks):
                if made._is_done(number) and number >= upto:
                    made._merge(number, file.partials(number))
            for number, tally in file.tallies():
                if made._is_done(number):
                    made.tally.merge(tally)
        return made

    @property
    def chunks(self) -> int:
        """The number of all chunks."""
        return -(-self.count // self.size)

    def _is_done(self, number: int) -> bool:
        return bool(self.status[number * self.size] != Status.NOT_RUN)

    @property
    def missing(self) -> list[int]:
        """The chunks that were not run."""
        return [number for number in range(self.chunks) if not self._is_done(number)]

    @property
    def done(self) -> int:
        """The number of cases that were run."""
        return int(np.count_nonzero(self.status != Status.NOT_RUN))

    def oldest(self) -> int:
        """Return the first chunk that is still awaited."""
        return self.upto

    def put(self, number: int, chunk: Chunk) -> None:
        """Take the results of a chunk; store them first."""
        if self.file is not None:
            self.file.write(number, chunk)
        first = number * self.size
        rows = slice(first, first + len(chunk.status))
        self.status[rows], self.t_reached[rows] = chunk.status, chunk.t_reached
        for k, name in enumerate(self.plan.columns):
            self.values[name][rows] = chunk.values[:, k]
        self.messages |= {first + case: message for case, message in chunk.messages.items()}
        self.tally.merge(chunk.tally)
        self._merge(number, list(chunk.partials))

    def _merge(self, number: int, partials: list[Partial]) -> None:
        """Merge the statistics of all chunks without a gap before them."""
        self._ahead[number] = partials
        while self.upto in self._ahead:
            own = self._ahead.pop(self.upto)
            pairs = zip(self.plan.statistics, self.merged, own, strict=True) if self.merged else ()
            self.merged = [statistic.merged(one, other) for statistic, one, other in pairs] or own
            self.upto += 1
        if self.upto - self._stored >= COMMIT:
            self.commit()

    def commit(self) -> None:
        """Store the merged statistics, if there is a file."""
        if self.file is not None and self.upto > self._stored:
            self.file.commit(self.upto, self.merged)
            self._stored = self.upto

    def over_time(self) -> dict[str, dict[str, Array]]:
        """Return the columns of all statistics, by output: arrays of shape (N,)."""
        names = list(self.plan.outputs)
        found: dict[str, dict[str, Array]] = {name: {} for name in names}
        for statistic, partial in zip(self.plan.statistics, self.merged, strict=False):
            for column, rows in statistic.columns(partial, names).items():
                for name, row in zip(names, rows, strict=True):
                    found[name][column] = row
        return found
