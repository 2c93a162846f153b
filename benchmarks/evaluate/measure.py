"""Rounds: contenders take turns, so that a machine that slows down slows all; medians of times and of ratios."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from dataclasses import dataclass
from math import ceil
from statistics import median

import numpy as np

from . import by_casadi, by_pinocchio, by_symbody
from .contender import FUNCTIONS, Contender
from .robot import Robot
from .states import Values, random_states

TOLERANCE = 1e-9
"""Largest difference of outputs, relative to the largest output, that rounding explains."""

RIVALS = {"Pinocchio": by_pinocchio, "CasADi": by_casadi}


@dataclass(frozen=True)
class Effort:
    """How long is measured."""

    rounds: int
    seconds: float
    """What a trial takes, at least."""


@dataclass(frozen=True)
class Timing:
    """What one contender did."""

    label: str
    times: tuple[float, ...]
    """Nanoseconds a state, of each round."""
    operations: int | None
    difference: float
    """From the first contender's outputs, relative to the largest of these."""

    @property
    def nanoseconds(self) -> float:
        """The median."""
        return median(self.times)

    @property
    def agrees(self) -> bool:
        """Whether it computes what the first contender does."""
        return self.difference <= TOLERANCE

    def over(self, other: Timing) -> float:
        """Return how many times longer it takes than another: the median over the rounds."""
        return median(a / b for a, b in zip(self.times, other.times, strict=True))


Results = dict[tuple[str, str], tuple[Timing, ...]]
"""By robot and function."""


def compare(robots: Sequence[Robot], effort: Effort) -> Results:
    """Return the timings of all functions of robots, by all contenders that the machine has."""
    results: Results = {}
    for robot in robots:
        states = random_states(robot)
        model = by_symbody.Model(robot, states)
        for function in FUNCTIONS:
            contenders = by_symbody.contenders(model, function)
            contenders += [r.contender(robot, states, function) for r in RIVALS.values() if not r.missing()]
            results[robot.name, function] = in_turns(contenders, effort)
            print(f"{robot.name}, {function}", file=sys.stderr, flush=True)
    return results


def in_turns(contenders: Sequence[Contender], effort: Effort) -> tuple[Timing, ...]:
    """Compare what the contenders compute, then time them."""
    repetitions = [_repetitions(contender, effort.seconds) for contender in contenders]
    outputs = [contender.outputs().copy() for contender in contenders]
    rounds = [
        [contender.time(often) for contender, often in zip(contenders, repetitions, strict=True)]
        for _ in range(effort.rounds)
    ]
    return tuple(
        Timing(contender.label, times, contender.operations, difference(outputs[0], found))
        for contender, found, times in zip(contenders, outputs, zip(*rounds, strict=True), strict=True)
    )


def difference(one: Values, other: Values) -> float:
    """Return the largest difference of outputs, relative to the largest output."""
    return float(np.abs(one - other).max() / np.abs(one).max())


def _repetitions(contender: Contender, seconds: float) -> int:
    """Run it, and return how often all states are run in one trial."""
    contender.time(1)
    return ceil(seconds * 1e9 / (contender.time(1) * len(contender.outputs())))
