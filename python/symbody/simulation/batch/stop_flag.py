"""A flag that stops the tasks of a call, visible in all processes of this machine."""

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
    """A flag that asks the tasks of a call to stop: a file that does not exist until then.

    The signal of Ctrl-C is not enough: a process that starts, or is between two tasks, may lose it and take the next
    task. The file is removed when the process that set the flag ends, after its children.

    >>> flag = StopFlag()
    >>> flag.is_set()
    False
    >>> flag.set()
    >>> flag.is_set()
    True
    """

    path: str = field(default_factory=_path)
    process: int = field(default_factory=os.getpid)

    def set(self) -> None:
        """Ask the tasks to stop. If no file can be made, they only get the signal."""
        with suppress(OSError):
            Path(self.path).touch()
            Finalize(None, _remove, (self.path,), exitpriority=-100)  # below 0: after children were joined

    def is_set(self) -> bool:
        """Return whether the tasks should stop."""
        return Path(self.path).exists()

    def is_of_this_process(self) -> bool:
        """Return whether this process made the flag."""
        return self.process == os.getpid()


def _remove(path: str) -> None:
    Path(path).unlink(missing_ok=True)
