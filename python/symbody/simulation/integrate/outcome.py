"""How an integration went, in the terms that all methods share."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from symbody.symbolic.numeric.deficiency import Deficiency

__all__ = ["Failure", "Outcome", "Statistics", "with_deficiencies"]


@dataclass(frozen=True)
class Statistics:
    """What an integration took: steps, steps tried again, evaluations; and whether the equations look stiff.

    IDA doesn't tell its steps: they are zero.
    """

    steps: int
    rejected: int
    evaluations: int
    jacobians: int
    is_stiff: bool


@dataclass(frozen=True)
class Failure:
    """Why a motion ended early: a word for the kind, the instant up to which it is known, and a sentence."""

    kind: str
    t: float
    message: str


@dataclass(frozen=True, eq=False)
class Outcome:
    """How an integration went.

    Attributes:
        states: the states at the instants that were reached, a row for each.
        occurrences: the number of an event, when it happened, and the state there.
        end: where the motion ended.
        failure: why it ended early, other than by an event.
        statistics: what it took.
        deficiencies: the linear systems without a unique solution that it met.
        imbalance: since when, and by which part of the largest energy that moves, the balance of energy was off; None
            where the errors of the steps explain what is off, or nobody knows the energy.
        trail: rows of the instant and the state at the ends of steps; empty where the integrator itself keeps a motion
            on the branch of its constraints.
        uncertain: when the integrator first took a step although it could not make sure of that.
    """

    states: NDArray[np.float64]
    occurrences: list[tuple[int, float, list[float]]]
    end: tuple[float, list[float]]
    failure: Failure | None
    statistics: Statistics
    deficiencies: frozenset[Deficiency] = frozenset()
    imbalance: tuple[float, float] | None = None
    trail: NDArray[np.float64] = field(default_factory=lambda: np.empty((0, 1)))
    uncertain: float | None = None


def with_deficiencies(outcome: Outcome, found: Iterable[Deficiency]) -> Outcome:
    """Return an outcome that met further linear systems without a unique solution; most meet none."""
    more = frozenset(found)
    return replace(outcome, deficiencies=outcome.deficiencies | more) if more else outcome
