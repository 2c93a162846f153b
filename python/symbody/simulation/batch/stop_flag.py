"""A sign that the tasks of a call stop, seen in all processes of this machine."""

from __future__ import annotations

import os
import tempfile
from contextlib import suppress
from dataclasses import dataclass, field
from multiprocessing.util import Finalize
from pathlib import Path
from uuid import uuid4


def _path() -> str:
    return str(Path(tempfile.gettempdir()) / f"symbody-stop-{uuid4().hex}")


@dataclass(frozen=True)
class StopFlag:
    """Stands for a call whose tasks may be told to stop: a file that isn't there until then.

    Ctrl-C alone doesn't do: a process that begins, or is between two tasks, may lose its signal, and takes the next
    task. The file goes when the process that put it up ends, after those that it waits for.

    >>> sign = StopFlag()
    >>> sign.is_set()
    False
    >>> sign.set()
    >>> sign.is_set()
    True
    """

    path: str = field(default_factory=_path)
    process: int = field(default_factory=os.getpid)

    def set(self) -> None:
        """Tell the tasks to stop; where no file can be made, signals are all that they get."""
        with suppress(OSError):
            Path(self.path).touch()
            Finalize(None, _take_down, (self.path,), exitpriority=-100)  # below 0: after children were joined

    def is_set(self) -> bool:
        """Return whether the tasks stop."""
        return Path(self.path).exists()

    def is_of_this_process(self) -> bool:
        """Return whether this is the process that made it."""
        return self.process == os.getpid()


def _take_down(path: str) -> None:
    Path(path).unlink(missing_ok=True)
