"""Ctrl-C as a request that is checked between two steps, so that what was computed is kept."""

from __future__ import annotations

import signal
import threading
from contextlib import AbstractContextManager
from types import FrameType, TracebackType
from typing import Any


class Interruption(AbstractContextManager["Interruption"]):
    """A context in which the first Ctrl-C only sets `is_asked_for`; a second one interrupts as usual.

    Only the main thread receives signals; in other threads this context does nothing.
    """

    def __init__(self) -> None:
        self.is_asked_for = False
        self._before: Any = None

    def __enter__(self) -> Interruption:
        if threading.current_thread() is threading.main_thread():
            self._before = signal.getsignal(signal.SIGINT)
            if callable(self._before):
                signal.signal(signal.SIGINT, self._note)
        return self

    def _note(self, number: int, frame: FrameType | None) -> None:
        if self.is_asked_for and callable(self._before):
            self._before(number, frame)
        self.is_asked_for = True

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        if callable(self._before):
            signal.signal(signal.SIGINT, self._before)
