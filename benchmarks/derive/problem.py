"""What a benchmark is: a problem, those who solve it, and what symbody must reach."""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence
from dataclasses import dataclass

from .engines import Engine, Expression
from .tape import Operations


def _same(name: str) -> str:
    return name


@dataclass(frozen=True)
class Contender:
    """A way to derive a problem of a given size with some engine."""

    engine: Engine
    method: str
    derive: Callable[[int], Sequence[Expression]]
    largest: int | None = None
    """Size beyond which it is not tried: minutes, or no end."""
    rename: Callable[[str], str] = _same
    """From its names of inputs to those of the problem."""

    @property
    def label(self) -> str:
        """Name the engine and the method."""
        return f"{self.engine.name}, {self.method}"

    def tries(self, size: int) -> bool:
        """Tell whether it is installed and the size is within its reach."""
        return self.engine.version is not None and (self.largest is None or size <= self.largest)


@dataclass(frozen=True)
class Measurement:
    """What one contender did at one size; times are medians."""

    derive: float
    """Seconds, building the model included."""
    compress: float
    """Seconds of common subexpression elimination."""
    operations: Operations
    outputs: tuple[float, ...]
    """Values at a random point, the same for all contenders."""

    @property
    def seconds(self) -> float:
        """Both times together."""
        return self.derive + self.compress


Results = dict[tuple[str, int], Measurement]
"""By label of the contender, and size."""


@dataclass(frozen=True)
class Target:
    """A bound on something measured at some sizes."""

    quantity: str
    bound: float
    sizes: tuple[int, ...]
    measured: Callable[[Results], float]
    unit: str = ""
    is_timed: bool = False


def time_target(label: str, size: int, bound: float) -> Target:
    """Bound the seconds of a contender."""
    quantity = f"{label}, n = {size}: time"
    return Target(quantity, bound, (size,), lambda results: results[label, size].seconds, "s", is_timed=True)


def operations_target(label: str, size: int, bound: int) -> Target:
    """Bound the operations of a contender."""
    quantity = f"{label}, n = {size}: operations"
    return Target(quantity, bound, (size,), lambda results: results[label, size].operations.total)


def joint_time_target(who: str, labels: Collection[str], size: int, bound: float) -> Target:
    """Bound the seconds of several contenders together."""
    measured = _seconds_of(labels, size)
    return Target(f"{who}, n = {size}: time", bound, (size,), measured, "s", is_timed=True)


def growth_target(who: str, labels: Collection[str], sizes: tuple[int, int], bound: float) -> Target:
    """Bound the seconds of several contenders at the larger size, over those at the smaller."""
    smaller, larger = sizes
    quantity = f"{who}: time of n = {larger} over n = {smaller}"
    below, above = _seconds_of(labels, smaller), _seconds_of(labels, larger)
    return Target(quantity, bound, sizes, lambda results: above(results) / below(results), is_timed=True)


def _seconds_of(labels: Collection[str], size: int) -> Callable[[Results], float]:
    return lambda results: sum(results[label, size].seconds for label in labels)


@dataclass(frozen=True)
class Problem:
    """Contenders that derive the same outputs."""

    name: str
    title: str
    statement: str
    sizes: tuple[int, ...]
    quick_sizes: tuple[int, ...]
    contenders: tuple[Contender, ...]
    targets: tuple[Target, ...]
