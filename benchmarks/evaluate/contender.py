"""Contenders: who computes a function of a robot, and how it is timed."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from .states import Values

FUNCTIONS = ("inverse dynamics", "mass matrix", "forward dynamics")


@dataclass(frozen=True)
class Contender:
    """One function by one tool.

    Attributes:
        label: the tool, and how.
        time: runs all states so many times and returns nanoseconds a state.
        outputs: the results of the last run, a row for each state.
        operations: how many a call takes, if it is known.
    """

    label: str
    time: Callable[[int], float]
    outputs: Callable[[], Values]
    operations: int | None = None
