"""Files of results: whole or not there, and of one problem only."""

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

from .results import Results

FORMAT = "symbody results 2"
"""What a file of results begins with; the number goes up when the meaning of its arrays changes."""


@dataclass(frozen=True)
class ResultsFile:
    """A file ``.npz`` that holds the results of one problem, finished or not.

    Attributes:
        path: where it is.
        problem: the digest of each part of the problem, by the words for it; see `digest`.
    """

    path: Path
    problem: Mapping[str, str]

    def read(self) -> Results | None:
        """Return the results that are there, or nothing if there is no file.

        Raises:
            ResultsError: the file can't be read, is no file of results, or one of another problem.
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
                f"simulate_many: {self.path} can't be read as a file of results ({reason}); it was left as it is. "
                "Give another path, or remove the file"
            ) from error

    def _check_problem(self, found: Mapping[str, str]) -> None:
        other = [part for part, text in self.problem.items() if found.get(part) != text]
        if other:
            raise ResultsError(
                f"simulate_many: {self.path} holds results of another problem: {_listed(other)} differ; it was left as "
                "it is. Give another path, or remove the file to compute anew"
            )

    def check_writable(self) -> None:
        """See, before anything is computed, that the file can be written.

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
        """Write all results under a temporary name beside the file, and rename it when all is on the disk.

        Raises:
            ResultsError: the file can't be written; what was there before is still there.
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
    """Return a text that two sequences share if and only if they are the same, on all machines.

    >>> digest(["m", b"1"]) == digest(["m", b"1"]), digest(["m", "1"]) == digest(["m1"])
    (True, False)
    """
    whole = hashlib.sha256()
    for thing in things:
        data = thing.encode() if isinstance(thing, str) else thing
        whole.update(len(data).to_bytes(8, "little"))
        whole.update(data)
    return whole.hexdigest()


def _listed(parts: list[str]) -> str:
    """Return words as a sentence lists them."""
    return " and ".join(filter(None, [", ".join(parts[:-1]), parts[-1]]))
