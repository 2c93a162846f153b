"""Files of studies: a Zarr store to which chunks are appended, which xarray and other programs read."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from symbody.errors import ResultsError
from symbody.simulation.batch.cases import Cases
from symbody.simulation.batch.problem_digest import problem_digest
from symbody.simulation.batch.results_file import digest
from symbody.simulation.given.extra import loaded
from symbody.simulation.integrate.tally import Tally
from symbody.symbolic.given.arguments import brief
from symbody.symbolic.given.wording import joined_by_and

from .chunk import Chunk
from .plan import PLACE, Plan
from .statistics.statistic import Partial
from .stored_parts import partials_in, put_partials, put_text
from .study_arrays import MESSAGE, StudyArrays

__all__ = ["StudyFile", "opened_file"]

FORMAT = "symbody study 2"
"""The number increases when the meaning of the arrays changes."""

TALLY = "tally_"
"""The names of the arrays of what chunks have found begin with this."""

COMMIT = 16
"""The number of chunks after which their merged statistics are stored."""

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class StudyFile:
    """A Zarr store whose arrays are divided as the study is, so that each chunk is written by itself.

    A chunk counts as finished when its status is there, which is written last: after an accident, no more is lost than
    the chunks in flight.

    Attributes:
        path: the folder of the store.
        plan: what is computed.
        cases: all cases.
        size: the number of cases of a chunk.
        problem: the digest of each part of the study, by the name of the part.
        units: the units of parameters, measures and outputs, by name.
    """

    path: Path
    plan: Plan
    cases: Cases
    size: int
    problem: Mapping[str, str]
    units: Mapping[str, str]

    def open(self) -> None:
        """Make the store, or check that the one that is there holds this study.

        Raises:
            ResultsError: it can't be written, is no study, or is another one.
        """
        zarr = loaded("zarr", f"{PLACE}: path={str(self.path)!r}")
        try:
            if self.path.exists() and any(self.path.iterdir()):
                self._check(zarr)
            else:
                self._make(zarr)
        except OSError as error:
            if isinstance(error, ResultsError):
                raise
            raise ResultsError(
                f"{PLACE}: {self.path} can't be written ({error.strerror or error}); nothing was changed there. Choose "
                "another path"
            ) from error

    def _check(self, zarr: Any) -> None:
        try:
            found = dict(zarr.open_group(self.path, mode="r").attrs)
        except Exception as error:
            raise self._unreadable(brief(error)) from error
        if found.get("format") != FORMAT:
            raise self._unreadable(f"it doesn't say '{FORMAT}'")
        stored = found.get("problem", {})
        other = [part for part, text in self.problem.items() if stored.get(part) != text]
        if other:
            parts = joined_by_and(other, most=len(other))
            raise ResultsError(
                f"{PLACE}: {self.path} contains another study: {parts} differ; the file was not changed. Give another "
                "path, or remove the file to start again"
            )
        if not found.get("is_made"):
            self._make(zarr)

    def _unreadable(self, reason: str) -> ResultsError:
        return ResultsError(
            f"{PLACE}: {self.path} can't be read as a study ({reason}); it was not changed. Give another path, or "
            "remove it"
        )

    def _make(self, zarr: Any) -> None:
        """Make all arrays, empty; mark the store as made at the end."""
        group = zarr.open_group(self.path, mode="w")
        group.attrs.update({"format": FORMAT, "problem": dict(self.problem)})
        self._arrays(group).make()
        group.create_group("progress")
        group.attrs["is_made"] = True

    def _arrays(self, group: Any) -> StudyArrays:
        return StudyArrays(group, self.plan, self.cases, self.size, self.units)

    @contextmanager
    def reading(self) -> Iterator[None]:
        """Turn what a damaged store raises into an error that names it."""
        try:
            yield
        except ResultsError:
            raise
        except Exception as error:
            raise self._unreadable(brief(error)) from error

    @contextmanager
    def _writing(self) -> Iterator[None]:
        try:
            yield
        except OSError as error:
            if isinstance(error, ResultsError):
                raise
            raise ResultsError(
                f"{PLACE}: {self.path} can't be written ({error.strerror or error}); the chunks before are there"
            ) from error

    @property
    def _group(self) -> Any:
        return loaded("zarr", PLACE).open_group(self.path, mode="r+")

    def read(self) -> tuple[NDArray[np.int8], Array, dict[str, Array]]:
        """Return the status of all cases, where they ended, and the numbers of the measures."""
        group = self._group
        columns = {name: np.asarray(group[name][:]) for name in self.plan.columns}
        return np.asarray(group["status"][:]), np.asarray(group["t_reached"][:]), columns

    def messages(self, failed: NDArray[np.intp]) -> dict[int, str]:
        """Return why cases failed."""
        if not failed.size:
            return {}
        rows = self._group["message"].oindex[failed]
        return {
            int(case): bytes(row).rstrip(b"\0").decode(errors="ignore")
            for case, row in zip(failed, rows, strict=True)
        }

    def write(self, number: int, chunk: Chunk) -> None:
        """Append a chunk; its status comes last.

        Raises:
            ResultsError: the store can't be written.
        """
        rows = slice(number * self.size, number * self.size + len(chunk.status))
        with self._writing():
            group = self._group
            for k, name in enumerate(self.plan.columns):
                group[name][rows] = chunk.values[:, k]
            if chunk.histories is not None:
                for k, name in enumerate(self.plan.outputs):
                    group[name][rows] = chunk.histories[:, k]
            if chunk.messages:
                texts = np.zeros((len(chunk.status), MESSAGE), dtype=np.uint8)
                for case, message in chunk.messages.items():
                    data = message.encode()[:MESSAGE]
                    texts[case, : len(data)] = np.frombuffer(data, dtype=np.uint8)
                group["message"][rows] = texts
            if chunk.partials:
                put_partials(group, f"chunk_{number}", chunk.partials)
            if len(chunk.tally):
                put_text(group, f"{TALLY}{number}", json.dumps(chunk.tally.rows()))
            group["t_reached"][rows] = chunk.t_reached
            group["status"][rows] = chunk.status

    def merged(self) -> tuple[int, list[Partial]]:
        """Return the number of chunks whose statistics are merged, and these."""
        group = self._group
        upto = int(group.attrs.get("merged", 0))
        return upto, partials_in(group, f"merged_{upto}") if upto else []

    def partials(self, number: int) -> list[Partial]:
        """Return the partial statistics of a finished chunk."""
        return partials_in(self._group, f"chunk_{number}") if self.plan.statistics else []

    def tallies(self) -> Iterator[tuple[int, Tally]]:
        """Yield what chunks have found, with their numbers."""
        progress = self._group["progress"]
        numbers = [int(name[len(TALLY) :]) for name in progress.array_keys() if name.startswith(TALLY)]
        for number in sorted(numbers):
            data = np.asarray(progress[f"{TALLY}{number}"][:]).tobytes()
            yield number, Tally.of_rows(json.loads(data))

    def commit(self, upto: int, merged: list[Partial]) -> None:
        """Store the merged statistics of the first chunks; then the parts that they replace are removed."""
        with self._writing():
            group = self._group
            before = int(group.attrs.get("merged", 0))
            if upto == before or not self.plan.statistics:
                return
            put_partials(group, f"merged_{upto}", merged)
            group.attrs["merged"] = upto
            for name in [f"merged_{before}", *(f"chunk_{number}" for number in range(before, upto))]:
                if name in group["progress"]:
                    del group["progress"][name]

    @property
    def is_finished(self) -> bool:
        """Whether all that belongs into the store is there."""
        return bool(self._group.attrs.get("is_finished", False))

    def finish(self, over_time: Mapping[str, Mapping[str, Array]], notices: Sequence[str]) -> None:
        """Write the statistics over time for other programs, one array for each output and column, and the notices."""
        with self._writing():
            group = self._group
            group.attrs["notices"] = [*notices]
            self._arrays(group).add_over_time(over_time)
            group.attrs["is_finished"] = True


def opened_file(path: Path, plan: Plan, cases: Cases, size: int, units: Mapping[str, str]) -> StudyFile:
    """Return the file of a study, made or checked.

    Args:
        path: its path.
        plan: what is computed.
        cases: all cases.
        size: the number of cases of a chunk.
        units: the units, by name.
    """
    problem = problem_digest(plan.with_names, cases)
    problem["the measures"] = digest(f"{name} {measure}" for name, measure in plan.measures.items())
    problem["the statistics"] = digest([*map(repr, plan.statistics), repr(plan.keeps_histories)])
    problem["the chunks"] = digest([str(size)])
    file = StudyFile(path, plan, cases, size, problem, units)
    file.open()
    return file
