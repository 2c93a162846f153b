"""Runs: many motions of one model, as arrays."""

from __future__ import annotations

import warnings
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from symbody.errors import ArgumentError, ModelNotice
from symbody.multibody import System
from symbody.symbolic import Expr
from symbody.symbolic.arguments import counted, described
from symbody.symbolic.deficiency import noting

from .batch import Batch
from .cases import Cases
from .integrator import Failure as IntegratorFailure
from .integrator import Outcome, Statistics
from .motion import Motion
from .motion_of import motion_of
from .named_constraint import shortened
from .notices import Finding, deficiency_findings, notices_of_batch
from .results import Results, Status

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Failure:
    """A motion that ended before its time, and not by an event.

    Attributes:
        index: which case it is.
        parameters: its parameters.
        initial: what was given of its initial state.
        message: why it ended.
        t_reached: the instant up to which it is known; NaN if it never began.
    """

    index: int
    parameters: dict[Expr, float]
    initial: dict[Expr, float]
    message: str
    t_reached: float


@dataclass(frozen=True, eq=False)
class Runs:
    """Many motions of one model at the same instants: what `simulate_many` returns.

    Where a motion ended before the last instant, its values are NaN from there on.
    """

    batch: Batch
    cases: Cases
    results: Results

    def __len__(self) -> int:
        """Return how many cases there are."""
        return self.cases.count

    @property
    def t(self) -> Array:
        """The instants, N of them."""
        return self.batch.instants

    @property
    def system(self) -> System:
        """What moves."""
        return self.batch.model.system

    @property
    def parameters(self) -> dict[Expr, Array]:
        """The parameters, a value for each case."""
        return self.cases.parameters

    @property
    def initial(self) -> dict[Expr, Array]:
        """What was given of the initial states, a value for each case."""
        return self.cases.initial

    @property
    def states(self) -> Array:
        """The states, k cases x N instants x n; their order is that of ``runs.batch.model.state``."""
        if not self.batch.keeps_states:
            raise ArgumentError(
                "runs: the states of these motions were not kept, only the outputs; give simulate_many "
                "keep_states=True, or name the expression in its outputs"
            )
        return self.results.states[:, :, : len(self.batch.model.state)]

    @cached_property
    def outputs(self) -> dict[str, Array]:
        """The outputs by name, k cases x N instants."""
        return {name: self.results.outputs[:, i] for i, name in enumerate(self.batch.outputs)}

    def __getitem__(self, expression: Expr) -> Array:
        """Return the values of an expression, k cases x N instants."""
        for name, output in self.batch.outputs.items():
            if output == expression:
                return self.outputs[name]
        states, values = self.states, np.full((len(self), len(self.t)), np.nan)
        findings: list[tuple[Finding, ...]] = [()] * len(self)
        for case, reached in enumerate(self.results.reached):
            if reached:
                with noting() as found:
                    values[case, :reached] = self.batch.values(
                        [expression], states[case, :reached], self.t[:reached], self._parameters_of(case)
                    )
                findings[case] = deficiency_findings(found, self.batch.model)
        for notice in notices_of_batch(findings, f"runs[{shortened(expression)}]"):
            warnings.warn(notice, ModelNotice, stacklevel=2)
        return values

    def motion(self, index: int) -> Motion:
        """Return the motion of one case: to plot, to animate, to look at its energy.

        Args:
            index: which case it is; negative ones count from the last.

        Raises:
            ArgumentError: there is no such case, it has no motion, or the states were not kept.
        """
        cases = len(self)
        if not hasattr(index, "__index__") or not -cases <= index < cases:
            raise ArgumentError(f"runs.motion: {described(index)}; expected one of the {cases} cases, from 0")
        case = int(index) % cases
        outcome = self.outcome(case)
        if outcome is None:
            _ = self.states
            why = str(self.results.messages[case]) or "it was not run"
            raise ArgumentError(f"runs.motion: case {case} has no motion: {why}")
        message = str(self.results.messages[case]) or "the last instant was reached"
        return motion_of(
            self.batch.model,
            self._parameters_of(case),
            self.t,
            self.batch.events,
            outcome,
            message,
            self.batch.outputs,
        )

    def _parameters_of(self, case: int) -> dict[Expr, float]:
        parameters = self.cases.parameters_of(case)
        if not self.batch.model.is_stabilized:
            return parameters
        return {**parameters, **self.batch.damping_of(parameters, self.results.states[case, 0])}

    def outcome(self, index: int) -> Outcome | None:
        """Return how the integration of one case went, at the instants it reached; None where it never began."""
        results, reached = self.results, int(self.results.reached[index])
        if reached == 0 or not self.batch.keeps_states:
            return None
        states, t_reached = results.states[index, :reached], float(results.t_reached[index])
        occurrences = [(event, t, state.tolist()) for event, t, state in results.occurrences[index]]
        end = float(self.t[reached - 1]), states[-1].tolist()
        if results.status[index] == Status.ENDED_BY_EVENT:
            end = occurrences[-1][1:]
        failed = results.status[index] == Status.FAILED
        steps, rejected, evaluations, jacobians, is_stiff = map(int, results.counts[index])
        return Outcome(
            states,
            occurrences,
            end,
            IntegratorFailure("failed", t_reached, str(results.messages[index])) if failed else None,
            Statistics(steps, rejected, evaluations, jacobians, bool(is_stiff)),
        )

    @cached_property
    def completed(self) -> NDArray[np.bool_]:
        """Which cases ran to their end: the last instant, or an event that ends the motion."""
        return np.isin(self.results.status, (Status.COMPLETED, Status.ENDED_BY_EVENT))

    @cached_property
    def failures(self) -> list[Failure]:
        """The cases that ended before their time."""
        return [
            Failure(
                i,
                self.cases.parameters_of(i),
                self.cases.initial_of(i),
                str(self.results.messages[i]),
                float(self.results.t_reached[i]),
            )
            for i in np.flatnonzero(self.results.status == Status.FAILED).tolist()
        ]

    @cached_property
    def findings(self) -> list[tuple[Finding, ...]]:
        """What a user should know of each case, such as that it is stiff; nothing of most."""
        return list(self.results.findings)

    @property
    def not_run(self) -> list[int]:
        """The cases that have not been run, as the batch was interrupted."""
        return [int(case) for case in self.results.missing]

    def __repr__(self) -> str:
        parts = [counted(len(self), "case"), counted(len(self.t), "instant")]
        parts += [f"{len(self.failures)} failed"] if self.failures else []
        parts += [f"{len(self.not_run)} not run"] if self.not_run else []
        return f"Runs({', '.join(parts)})"
