"""Rounds of trials, each in its own process; contenders take turns, so that a machine that slows down slows all."""

from __future__ import annotations

from statistics import median

import numpy as np

from ..own_process import in_own_process
from .problem import Contender, Measurement, Problem
from .trial import from_json, trial

SLOW = 5.0
"""Seconds beyond which one trial is enough."""

Results = dict[str, Measurement | None]
"""By label; None for a contender that gave no result in time."""


def in_this_process(problem: Problem) -> Results:
    """Try the contenders that are fast, once: for tests, and for a first look."""
    return {each.label: trial(each) for each in problem.contenders if each.is_installed and not each.is_slow}


def in_turns(problem: Problem, rounds: int, *, has_slow: bool) -> Results:
    """Return the medians of several rounds."""
    trials: dict[str, list[Measurement]] = {}
    given_up: set[str] = set()
    contenders = [each for each in problem.contenders if each.is_installed and (has_slow or not each.is_slow)]
    for _ in range(rounds):
        for contender in contenders:
            done = trials.get(contender.label, [])
            if contender.label in given_up or (done and done[0].seconds > SLOW):
                continue
            found = _isolated(problem, contender)
            if found is None:
                given_up.add(contender.label)
            else:
                trials.setdefault(contender.label, []).append(found)
    results: Results = dict.fromkeys(given_up)
    return results | {
        label: Measurement(median(each.seconds for each in done), done[0].values)
        for label, done in trials.items()
    }


def agree(one: Measurement, other: Measurement) -> bool:
    """Tell whether two contenders found the same eigenvalues, as zeros of one polynomial: double ones are vague."""
    if not other.values:
        return True
    polynomials = [np.poly(np.array(each.values)) for each in (one, other)]
    size = np.abs(polynomials[0]).max()
    return len(one.values) == len(other.values) and bool(
        np.abs(np.subtract(*polynomials)).max() <= 1e-6 * size
    )


def _isolated(problem: Problem, contender: Contender) -> Measurement | None:
    printed = in_own_process("benchmarks.linear.trial", problem.name, contender.label)
    return None if printed is None else from_json(printed)
