"""The outcome of an integration, in the same form for all methods."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field, replace
from enum import StrEnum

import numpy as np
from numpy.typing import NDArray

from symbody.symbolic.numeric.deficiency import Deficiency

__all__ = ["Failure", "FailureKind", "Outcome", "Sensitivities", "Statistics", "with_deficiencies"]


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


class FailureKind(StrEnum):
    """How a motion ended early. The native integrator reports the first seven, by these words."""

    NOT_FINITE = "not_finite"
    """A rate of the state is not a finite number."""
    STEP_COLLAPSE = "step_collapse"
    """No step, however short, meets the tolerances."""
    STALLED = "stalled"
    """The steps are so short that they would never reach the end."""
    PROJECTION = "projection"
    """The state can't be put back onto the constraints."""
    SINGULAR = "singular"
    """The constraints would change a speed by more than the error of a step."""
    INTERRUPTED = "interrupted"
    """`KeepGoing` returned False; what was computed is kept."""
    LIBRARY = "library"
    """A library gave up; its message is part of a sentence."""
    EXPLAINED = "explained"
    """The method gave up, and its message says all: when, why, and the way out."""
    CONTRADICTION = "contradiction"
    """Equations contradict each other; the message says when, and which."""


@dataclass(frozen=True)
class Failure:
    """Why a motion ended early: the kind, the last known instant, and a message."""

    kind: FailureKind
    t: float
    message: str


@dataclass(frozen=True, eq=False)
class Sensitivities:
    """The derivatives of the state by k parameters and initial values.

    Attributes:
        states: at the N instants that were reached, shape (N, n, k).
        end: where the motion ended, shape (n, k).
        occurrences: at the events, shape (events, n, k).
        jump: the instant after which they are unknown, as the rates jump there, and the function that is zero there.
    """

    states: NDArray[np.float64]
    end: NDArray[np.float64]
    occurrences: NDArray[np.float64]
    jump: tuple[float, str] | None = None


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
        sensitivities: the derivatives of the state by parameters; None if none were asked for.
        left: why a device left the motion to the host; empty for all others.
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
    sensitivities: Sensitivities | None = None
    left: str = ""


def with_deficiencies(outcome: Outcome, found: Iterable[Deficiency]) -> Outcome:
    """Add further linear systems without a unique solution to an outcome."""
    more = frozenset(found)
    return replace(outcome, deficiencies=outcome.deficiencies | more) if more else outcome
