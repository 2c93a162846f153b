"""What the project must reach, and whether it did."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from .measure import Results, Timing

PANDA, CHAIN, SOLO = "panda", "chain of 30 general bodies", "solo12"
INVERSE, FORWARD = "inverse dynamics", "forward dynamics"


@dataclass(frozen=True)
class Speed:
    """How many times longer a rival must take, at least."""

    robot: str
    function: str
    rival: str
    bound: float

    @property
    def quantity(self) -> str:
        """What is measured."""
        return f"{self.robot}, {self.function}: {self.rival} over symbody"

    def measured(self, results: Results) -> list[float]:
        """Return the ratios to machine code and to generated C, none if the rival is missing."""
        timings = results.get((self.robot, self.function), ())
        rivals = [timing for timing in timings if timing.label.startswith(self.rival)]
        return [rival.over(own) for rival in rivals for own in _own(timings)]


def _own(timings: tuple[Timing, ...]) -> list[Timing]:
    return [timing for timing in timings if timing.label.startswith("symbody")]


SPEEDS = (
    Speed(PANDA, INVERSE, "Pinocchio", 6.0),
    Speed(PANDA, INVERSE, "CasADi", 1.4),
    Speed(PANDA, FORWARD, "Pinocchio", 4.0),
    Speed(PANDA, FORWARD, "CasADi", 1.0),
    Speed(CHAIN, INVERSE, "Pinocchio", 3.5),
    Speed(CHAIN, FORWARD, "Pinocchio", 2.5),
    Speed(SOLO, INVERSE, "Pinocchio", 3.0),
    Speed(SOLO, FORWARD, "Pinocchio", 2.5),
)


@dataclass(frozen=True)
class Bound:
    """A number that must be at most, or at least, another."""

    quantity: str
    bound: float
    measured: Callable[[], float]
    unit: str = ""
    at_least: bool = False

    def is_met(self, value: float) -> bool:
        """Whether the value is within."""
        return value >= self.bound if self.at_least else value <= self.bound
