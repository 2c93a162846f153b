"""Files of results: each holds one problem, and is written as a whole or not at all."""

from __future__ import annotations

import hashlib
import tempfile
import zipfile
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, BinaryIO

import numpy as np

from symbody.errors import ResultsError
from symbody.files.replacement import replacement
from symbody.simulation.batch.case_arrays import Results
from symbody.symbolic.given.wording import joined_by_and

FORMAT = "symbody results 3"
"""The first entry of a results file; the number increases when the meaning of the arrays changes."""


@dataclass(frozen=True)
class ResultsFile:
    """A file ``.npz`` with the results of one problem, finished or not.

    Attributes:
        path: the path of the file.
        problem: the digest of each part of the problem, by the name of the part; see `digest`.
    """

    path: Path
    problem: Mapping[str, str]

    def read(self) -> Results | None:
        """Return the results in the file; None if there is no file.

        Raises:
            ResultsError: the file can't be read, is not a results file, or belongs to another problem.
        """
        if not self.path.exists():
            return None
        try:
            with self.path.open("rb") as file, np.load(file, allow_pickle=False) as stored:
                arrays = dict(stored)
            if arrays.pop("format", np.array("")) != FORMAT:
                raise ValueError(f"it doesn't say '{FORMAT}'")
            found = dict(zip(arrays.pop("parts").tolist(), arrays.pop("digests").tolist(), strict=True))
            self._check_problem(found)
            return Results.of_arrays(arrays)
        except (OSError, EOFError, ValueError, KeyError, AttributeError, zipfile.BadZipFile) as error:
            if isinstance(error, ResultsError):
                raise
            reason = getattr(error, "strerror", None) or error
            raise ResultsError(
                f"simulate_many: {self.path} can't be read as a results file ({reason}); the file was not "
                "changed. Give another path, or remove the file"
            ) from error

    def _check_problem(self, found: Mapping[str, str]) -> None:
        other = [part for part, text in self.problem.items() if found.get(part) != text]
        if other:
            parts = joined_by_and(other, most=len(other))
            raise ResultsError(
                f"simulate_many: {self.path} contains results of another problem: {parts} differ; the file "
                "was not changed. Give another path, or remove the file to start again"
            )

    def check_writable(self) -> None:
        """Check, before anything is computed, that the file can be written.

        Raises:
            ResultsError: it can't.
        """
        try:
            place = self.path.resolve()
            place.parent.mkdir(parents=True, exist_ok=True)
            if place.is_dir():
                raise IsADirectoryError(0, "it is a folder")
            with tempfile.TemporaryDirectory(prefix=".symbody-", dir=place.parent):
                pass
        except OSError as error:
            raise self._unwritable(error) from error

    def write(self, results: Results) -> None:
        """Write all results to a temporary file in the same folder, and rename it when it is complete.

        Raises:
            ResultsError: the file can't be written; its previous content is still there.
        """
        try:
            with replacement(self.path, durable=True) as temporary, temporary.open("wb") as file:
                self._save(file, results)
        except OSError as error:
            raise self._unwritable(error) from error

    def _save(self, file: BinaryIO, results: Results) -> None:
        arrays: dict[str, Any] = results.arrays()
        parts, digests = list(self.problem), list(self.problem.values())
        np.savez(file, format=FORMAT, parts=parts, digests=digests, **arrays)

    def _unwritable(self, error: OSError) -> ResultsError:
        return ResultsError(
            f"simulate_many: {self.path} can't be written ({error.strerror or error}); nothing was changed there. "
            "Choose another path"
        )


def digest(things: Iterable[str | bytes]) -> str:
    """Return a text that is the same for two sequences if and only if they are equal, on all machines.

    >>> digest(["m", b"1"]) == digest(["m", b"1"]), digest(["m", "1"]) == digest(["m1"])
    (True, False)
    """
    whole = hashlib.sha256()
    for thing in things:
        data = thing.encode() if isinstance(thing, str) else thing
        whole.update(len(data).to_bytes(8, "little"))
        whole.update(data)
    return whole.hexdigest()
