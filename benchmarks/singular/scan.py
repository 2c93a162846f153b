"""What becomes of motions through singular positions."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cache

import numpy as np

from tests.simulation.singular_scan import branch_of, mechanism, moved, scanned

MECHANISMS = {
    "one": "a four-bar linkage of equal bars",
    "two": "two of them in a row",
    "ten": "ten of them",
    "forty": "forty of them",
    "parallelogram": "a parallelogram",
    "kite": "a kite",
    "slider_crank": "a slider-crank, rod as long as crank",
}
"""The mechanisms of the scan, by their names there."""

METHODS = ("dop853", "tsit5")
TOLERANCES = (1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11)

OTHERS = [
    ("bdf", "projection"),
    ("esdirk34", "projection"),
    ("tr_bdf2", "projection"),
    ("dop853", "free"),
    ("tsit5", "free"),
    ("dop853", "baumgarte"),
    ("ida", "projection"),
    ("ida2", "projection"),
    ("ida3", "projection"),
]
"""Ways that don't see to it that a motion stays on its branch, or can't always pass."""

OFF, BOUND = 1e-2, 10.0
"""By how much a motion may be off its branch, in rad or m, and by which factor it may lose more energy than a bar."""


@dataclass(frozen=True)
class Loss:
    """The energy that the motions of a mechanism lose, relative to the largest energy that moves.

    Attributes:
        name: the mechanism.
        method: how it was integrated, with projection.
        rtol: the tolerance.
        motions: how many there were.
        passed: how many came to their end on their branch.
        median: what one of them loses.
        largest: the most that one loses.
        regular: the most that a bar loses which swings alone, with the same speeds.
    """

    name: str
    method: str
    rtol: float
    motions: int
    passed: int
    median: float
    largest: float
    regular: float


def losses(
    names: Iterable[str] = MECHANISMS, tolerances: Sequence[float] = TOLERANCES, every: int = 1
) -> list[Loss]:
    """Scan mechanisms with each method and tolerance, with every so many of the speeds."""
    cases = [(name, method, rtol) for name in names for method in METHODS for rtol in tolerances]
    return [_loss(name, method, rtol, every) for name, method, rtol in cases]


def _loss(name: str, method: str, rtol: float, every: int) -> Loss:
    speeds = mechanism(name)[1][::every]
    found = scanned(name, speeds, method=method, rtol=rtol)
    passed = [not failure and off < OFF for failure, off in zip(found.failures, found.off, strict=True)]
    regular = _regular(tuple(speeds), method, rtol)
    return Loss(
        name,
        method,
        rtol,
        len(speeds),
        sum(passed),
        float(np.median(found.drift)),
        found.drift.max(),
        regular,
    )


@cache
def _regular(speeds: tuple[float, ...], method: str, rtol: float) -> float:
    return float(scanned("bar", np.array(speeds), method=method, rtol=rtol).drift.max())


@dataclass(frozen=True)
class Passages:
    """What became of motions by one of the other ways: how many of each kind.

    Attributes:
        method: how they were integrated.
        constraints: how their constraints were kept.
        kinds: "passed", "noticed" with a notice, "ended" with an error, and "silent", wrong without a word.
    """

    method: str
    constraints: str
    kinds: Counter[str]


def others(names: Iterable[str] = ("one", "two", "kite", "slider_crank"), speeds: int = 5) -> list[Passages]:
    """Move mechanisms by the other ways, at two tolerances and with two asked instants."""
    return [
        Passages(
            method,
            constraints,
            Counter(
                _kind(name, speed, method=method, constraints=constraints, rtol=rtol)
                for name in names
                for speed in mechanism(name)[1][:: len(mechanism(name)[1]) // speeds]
                for rtol in (1e-4, 1e-7)
            ),
        )
        for method, constraints in OTHERS
    ]


def _kind(name: str, speed: float, **options: object) -> str:
    found, _ = mechanism(name)
    motion, said = moved(found, speed, t=(0, 5), **options)
    if not motion.completed:
        return "ended"
    if said:
        return "noticed"
    bar, _ = moved(mechanism("bar")[0], speed, t=(0, 5), **{**options, "constraints": "projection"})
    is_wrong = branch_of(found, motion) > OFF or motion.energy_drift > BOUND * bar.energy_drift
    return "silent" if is_wrong else "passed"
