"""Rounds of trials, each in its own process; contenders take turns, so that a machine that slows down slows all."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from dataclasses import replace
from statistics import median

from ..own_process import in_own_process
from .problem import Contender, Measurement, Problem, Results
from .trial import from_json, trial

SLOW = 5.0
"""Seconds beyond which one trial is enough."""

TOLERANCE = 1e-9
"""Largest difference of outputs, relative to the largest output, that rounding explains."""


def in_this_process(problem: Problem, sizes: tuple[int, ...]) -> Results:
    """Try all contenders once: for tests, and for a first look."""
    return {(contender.label, size): trial(contender, size) for contender, size in _entries(problem, sizes)}


def in_turns(problem: Problem, rounds: int) -> Results:
    """Return the medians of several rounds."""
    trials: dict[tuple[str, int], list[Measurement]] = {}
    given_up: set[tuple[str, int]] = set()
    for _ in range(rounds):
        for contender, size in _entries(problem, problem.sizes):
            key = contender.label, size
            if key in given_up or (key in trials and trials[key][0].seconds > SLOW):
                continue
            measurement = _isolated_trial(problem, contender, size)
            if measurement is None:
                given_up.add(key)
            else:
                trials.setdefault(key, []).append(measurement)
            print(".", end="", file=sys.stderr, flush=True)
    print(f" {problem.name}", file=sys.stderr)
    return {key: _medians(measurements) for key, measurements in trials.items()}


def difference(one: Measurement, other: Measurement) -> float:
    """Return the largest difference of outputs, relative to the largest output."""
    pairs = zip(one.outputs, other.outputs, strict=True)
    return max(abs(a - b) for a, b in pairs) / max(map(abs, one.outputs))


def agree(one: Measurement, other: Measurement) -> bool:
    """Tell whether two contenders derived the same thing."""
    return difference(one, other) <= TOLERANCE


def _entries(problem: Problem, sizes: tuple[int, ...]) -> Iterator[tuple[Contender, int]]:
    for size in sizes:
        for contender in problem.contenders:
            if contender.tries(size):
                yield contender, size


def _isolated_trial(problem: Problem, contender: Contender, size: int) -> Measurement | None:
    printed = in_own_process("benchmarks.derive.trial", problem.name, contender.label, str(size))
    return None if printed is None else from_json(printed)


def _medians(measurements: list[Measurement]) -> Measurement:
    return replace(
        measurements[0],
        derive=median(m.derive for m in measurements),
        compress=median(m.compress for m in measurements),
    )
