"""A session: the names and their values, the last values, aliases, options and modes."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, TypeAlias

from symbody.worksheet.value import Array, Reference, Table, Value

__all__ = ["Command", "Session"]


@dataclass
class Session:
    """What commands read and write.

    Attributes:
        names: the value of each name that was assigned.
        count: the number of assignments so far: a value with an older stamp may hold names that have values now.
        folder: where files are written; nothing is written elsewhere.
        lines: what the statement has printed so far, in order: printed values, ``printf``, warnings.
        notices: what the user should know that Maple doesn't print.
        mechanics: the modes of MBSymba (`worksheet/mechanics.py`); None until one of its commands runs.
    """

    names: dict[str, Value] = field(default_factory=dict)
    count: int = 0
    folder: Path = field(default_factory=Path)
    lines: list[str] = field(default_factory=list)
    notices: list[str] = field(default_factory=list)
    mechanics: Any = None

    def current(self, value: Value) -> Value:
        """Return a value with all that was assigned since it was made: scalars, matrices, lists; tables as they are.

        The chain of a matrix that is a frame is substituted too: `frame_face.current`.
        """
        raise NotImplementedError

    def resolve(self, value: Value) -> Value:
        """Return the table, the matrix or the procedure that a reference stands for; other values as they are."""
        while isinstance(value, Reference) and value.name in self.names:
            value = self.names[value.name]
        return value

    def table(self, value: Value) -> Table | Array:
        """Return the mutable object that a value stands for; raise what the user should read if it is another."""
        raise NotImplementedError


# A command takes the session and its evaluated arguments, sequences flattened, options as relations.
Command: TypeAlias = Callable[..., Value]
