"""Parcels: what all tasks of a batch share, prepared once in each process."""

from __future__ import annotations

import hashlib
import pickle
from collections.abc import Iterator
from contextlib import contextmanager
from functools import cached_property
from typing import Any, Generic, TypeVar

Content = TypeVar("Content")

OPEN = 4
"""The contents that this process keeps: a worker that serves several batches in turn compiles none of them twice."""

_opened: dict[str, Any] = {}


class Parcel(Generic[Content]):
    """Something that is costly to prepare, such as a model to compile, on its way to other processes.

    In the process of the sender it is the object itself. Elsewhere the first task unpacks it, and later tasks find it
    with all that was prepared.
    """

    def __init__(self, content: Content) -> None:
        self.content = content

    @cached_property
    def _packed(self) -> tuple[str, bytes]:
        data = pickle.dumps(self.content)
        return hashlib.sha256(data).hexdigest(), data

    def __reduce__(self) -> tuple[Any, ...]:
        return _unpacked, self._packed

    @contextmanager
    def open_here(self) -> Iterator[None]:
        """Let tasks of this process, and of its forks, use what is prepared here."""
        name, _ = self._packed
        _opened[name] = self
        try:
            yield
        finally:
            _opened.pop(name, None)


def _unpacked(name: str, data: bytes) -> Any:
    if name not in _opened:
        for oldest in list(_opened)[: max(0, len(_opened) - OPEN + 1)]:
            _opened.pop(oldest, None)
        _opened[name] = Parcel(pickle.loads(data))
    return _opened[name]
