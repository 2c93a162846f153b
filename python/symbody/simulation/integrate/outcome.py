"""The outcome of an integration, in the same form for all methods."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from symbody.symbolic.numeric.deficiency import Deficiency

__all__ = ["Failure", "Outcome", "Statistics", "with_deficiencies"]


@dataclass(frozen=True)
class Statistics:
    """The cost of an integration: steps, rejected steps, evaluations; and whether the equations seem stiff.

    IDA does not report its steps: they are zero.
    """

    steps: int
    rejected: int
    evaluations: int
    jacobians: int
    is_stiff: bool


@dataclass(frozen=True)
class Failure:
    """Why a motion ended early: a word for the kind, the last known instant, and a sentence."""

    kind: str
    t: float
    message: str


@dataclass(frozen=True, eq=False)
class Outcome:
    """The outcome of an integration.

    Attributes:
        states: the states at the N instants that were reached, shape (N, width).
        occurrences: for each event, its index, the instant, and the state there.
        end: the instant and the state at which the motion ended.
        failure: why it ended early, unless an event ended it.
        statistics: the cost of the integration.
        deficiencies: the linear systems without a unique solution that it met.
        imbalance: since when the energy balance was off, and by which part of the largest varying energy; None where
            the errors of the steps explain the difference, or the energy is not known.
        trail: the instant and the state at the ends of steps, one row for each; empty if the integrator itself keeps
            the motion on its branch of the constraints.
        uncertain: the instant of the first step for which the integrator could not ensure that.
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
    """Add further linear systems without a unique solution to an outcome."""
    more = frozenset(found)
    return replace(outcome, deficiencies=outcome.deficiencies | more) if more else outcome
