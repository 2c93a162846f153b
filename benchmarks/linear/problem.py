"""What a benchmark of linear models is: a task, those who do it, and what symbody must reach."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

Values = Sequence[complex]
"""What a contender finds, for a comparison: eigenvalues."""


@dataclass(frozen=True)
class Contender:
    """A way to do a task."""

    label: str
    solve: Callable[[], Values]
    """From nothing to the eigenvalues; empty if the contender compares its results itself."""
    is_slow: bool = False
    """Whether it takes minutes; ``--without-slow`` leaves it out."""
    is_installed: bool = True


@dataclass(frozen=True)
class Problem:
    """A task, and the seconds in which symbody, the first contender, must do it."""

    name: str
    title: str
    statement: str
    contenders: tuple[Contender, ...]
    bound: float


@dataclass(frozen=True)
class Measurement:
    """What one contender took, and found."""

    seconds: float
    values: tuple[complex, ...]
