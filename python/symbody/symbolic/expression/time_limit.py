"""A limit of time for what the compiled core does, for programs that run what others wrote."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

from symbody.symbolic import _core

__all__ = ["time_limit"]


@contextmanager
def time_limit(seconds: float) -> Iterator[None]:
    """Let long operations on expressions, and motions, raise `TimeoutError` after some seconds.

    The limit holds for the calls of this thread. An inner limit replaces the outer one until it ends.

    Raises:
        TimeoutError: the time was over within an operation.

    >>> from symbody import expand, symbols
    >>> x, y, z = symbols("x y z")
    >>> with time_limit(0.05):
    ...     expand((1 + x + y + z) ** 400)
    Traceback (most recent call last):
    ...
    TimeoutError: the time limit is over
    """
    before = _core.limit_time(seconds)
    try:
        yield
    finally:
        _core.limit_time(before)
