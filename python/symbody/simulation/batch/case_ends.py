"""How the cases of a batch or of a study ended: which failed, which were not run, and the notices of both."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from symbody.simulation.batch.case_arrays import Status
from symbody.symbolic import Expr

from .cases import Cases

__all__ = ["CaseEnds", "FailedCase"]


@dataclass(frozen=True)
class FailedCase:
    """A motion that ended early, and not by an event.

    Attributes:
        index: the number of the case.
        parameters: its parameters.
        initial: its given initial values.
        message: why it ended.
        t_reached: the last known instant, in s; NaN if it was not started.
    """

    index: int
    parameters: dict[Expr, float]
    initial: dict[Expr, float]
    message: str
    t_reached: float


@dataclass(frozen=True, eq=False)
class CaseEnds:
    """The ends of k cases.

    Attributes:
        cases: their parameters and initial values.
        status: how each ended, a `Status`, shape (k,).
        t_reached: the last known instant of each, shape (k,).
        message_of: returns why a case failed.
    """

    cases: Cases
    status: NDArray[np.int8]
    t_reached: NDArray[np.float64]
    message_of: Callable[[int], str]

    @property
    def completed(self) -> NDArray[np.bool_]:
        """Whether each case reached the last instant or a terminal event, shape (k,)."""
        return np.isin(self.status, (Status.COMPLETED, Status.ENDED_BY_EVENT))

    @property
    def failed(self) -> NDArray[np.intp]:
        """The numbers of the cases that failed."""
        return np.flatnonzero(self.status == Status.FAILED)

    @property
    def not_run(self) -> NDArray[np.intp]:
        """The numbers of the cases that were not run."""
        return np.flatnonzero(self.status == Status.NOT_RUN)

    def failure(self, case: int) -> FailedCase:
        """Return a case that failed, with its parameters."""
        return FailedCase(
            case,
            self.cases.parameters_of(case),
            self.cases.initial_of(case),
            self.message_of(case),
            float(self.t_reached[case]),
        )

    def notices(self, reason: str, *, values: str, gaps: str, has_path: bool) -> list[str]:
        """Return how many cases failed, and how many were not run, if there are any.

        Args:
            reason: why some were not run.
            values: what became of the values of cases that failed.
            gaps: the same of cases that were not run.
            has_path: whether the results have a file.
        """
        found, count = [], len(self.status)
        if self.failed.size:
            first = self.failure(int(self.failed[0]))
            given = {**first.parameters, **first.initial}
            listed = ", ".join(f"{name} = {value:.6g}" for name, value in given.items())
            found.append(
                f"{self.failed.size} of {count} motions failed; the first is case {first.index} ({listed}): "
                f"{first.message.rstrip('.')}. All are in .failures; {values}"
            )
        if self.not_run.size:
            advice = (
                "the same call goes on with the rest"
                if has_path
                else "give a path to keep results for another call"
            )
            found.append(
                f"{self.not_run.size} of {count} motions were not run ({reason}); they are in .not_run, {gaps}; "
                f"{advice}"
            )
        return found
