"""Batches: what many motions of one model share, and how some of them are run."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from symbody.errors import SymbodyError
from symbody.symbolic import Expr
from symbody.symbolic.deficiency import noting

from .baumgarte_choice import chosen_damping
from .begin import begin, begin_free
from .cases import Cases
from .contradictory_constraints import without_contradictions
from .diagnosis import diagnosis
from .event import Event
from .ida import IDA_FORMS
from .ida_outcome import ida_outcome
from .integrator import Options, Outcome, Problem, run_many, trail_of
from .model import DAMPING, Model
from .notices import Integrated, deficiency_findings, findings_of
from .results import Results, Status

Array = NDArray[np.float64]

LOOK = 32
"""Initial states between two looks for Ctrl-C."""


@dataclass(frozen=True, eq=False)
class Batch:
    """What many motions of one model share.

    Attributes:
        model: what moves.
        instants: when its states are asked for.
        options: how to integrate.
        constraints: how constraints are kept; see `simulate`.
        outputs: expressions to evaluate at all instants, by name.
        events: what to look for.
        guess: where to look for the initial states of constrained systems.
        keeps_states: whether the states are results, or only the outputs.
    """

    model: Model
    instants: Array
    options: Options
    constraints: str | tuple[float, float]
    outputs: Mapping[str, Expr]
    events: tuple[Event, ...]
    guess: Mapping[Expr, float]
    keeps_states: bool

    def __getstate__(self) -> dict[str, Any]:
        """Leave behind what is compiled, which is of this process."""
        return {name: value for name, value in self.__dict__.items() if name in self.__dataclass_fields__}

    @property
    def expressions(self) -> list[Expr]:
        """What is asked of the model: outputs, events, and what stands for inputs."""
        events = (event.expression for event in self.events)
        return [*self.outputs.values(), *events, *dict(self.model.inputs).values()]

    @cached_property
    def problem(self) -> Problem:
        """The compiled functions of the integration."""
        return Problem.of(
            self.model,
            self.options.method,
            is_projected=self.constraints == "projection",
            events=self.events,
        )

    @property
    def trail(self) -> int:
        """How many states at the ends of steps are kept of a motion, at most."""
        return trail_of(self.model, self.options.method, is_projected=self.constraints == "projection")

    def damping_of(self, parameters: Mapping[Expr, float], state: Array) -> dict[Expr, float]:
        """Return the frequency and the damping ratio with which violations of constraints die out, if they do.

        Args:
            parameters: those of a case.
            state: where it begins.
        """
        if not self.model.is_stabilized:
            return {}
        damping = self.constraints
        if isinstance(damping, str):
            values = np.array([parameters[name] for name in self._plain.parameters])
            damping = chosen_damping(self._plain, values, state, self.instants)
        return dict(zip(DAMPING, damping, strict=True))

    @cached_property
    def _plain(self) -> Model:
        return replace(self.model, is_stabilized=False, _functions={})

    def empty_results(self, cases: int) -> Results:
        """Return results without values."""
        kept = len(self.instants) if self.keeps_states else 0
        return Results.empty(cases, len(self.instants), kept, self.width, len(self.outputs))

    def run(
        self, cases: Cases, threads: int = 1, keep_going: Callable[[float], bool] | None = None
    ) -> Results:
        """Run some cases, in native threads; one that can't begin, or ends early, says why."""
        results = self.empty_results(cases.count)
        begun, states = self._starts(cases, results, keep_going)
        running = self._damped(cases.some(begun), states)
        outcomes = self._outcomes(running, states, threads, keep_going)
        for place, (case, outcome) in enumerate(zip(begun, outcomes, strict=True)):
            if outcome is not None:
                parameters = running.parameters_of(place)
                judged = without_contradictions(outcome, self.model, parameters, self.instants)
                self._record(results, int(case), judged, parameters)
        return results

    def _damped(self, cases: Cases, states: Array) -> Cases:
        """Return the cases with the parameters of Baumgarte's stabilisation, where there is one."""
        if not self.model.is_stabilized or not cases.count:
            return cases
        chosen = [self.damping_of(cases.parameters_of(k), state) for k, state in enumerate(states)]
        columns = {name: np.array([damping[name] for damping in chosen]) for name in DAMPING}
        return replace(cases, parameters={**cases.parameters, **columns})

    def _outcomes(
        self, cases: Cases, states: Array, threads: int, keep_going: Callable[[float], bool] | None
    ) -> Iterable[Outcome | None]:
        """Return how the integration of each case went; None where it was not begun."""
        if not len(states):
            return []
        if self.options.method in IDA_FORMS:
            return self._by_ida(cases, states, keep_going or (lambda _: True))
        parameters = np.empty((len(states), len(self.problem.parameters)))
        for place, name in enumerate(self.problem.parameters):
            parameters[:, place] = cases.parameters[name]
        return run_many(self.problem, states, parameters, self.instants, self.options, threads, keep_going)

    def _by_ida(
        self, cases: Cases, states: Array, keep_going: Callable[[float], bool]
    ) -> Iterator[Outcome | None]:
        for case, state in enumerate(states):
            if not keep_going(case):
                yield None
                continue
            parameters, start = cases.parameters_of(case), state[: len(self.model.state)]
            with noting() as found:
                outcome = ida_outcome(
                    self.model,
                    start,
                    parameters,
                    self.instants,
                    self.options,
                    self.events,
                    _still(keep_going, case),
                )
            yield replace(outcome, deficiencies=frozenset(found))

    def _starts(
        self, cases: Cases, results: Results, keep_going: Callable[[float], bool] | None
    ) -> tuple[NDArray[np.intp], Array]:
        """Return the cases that can begin, and their states; the others fail."""
        states = begin_free(self.model, cases, self.guess)
        for looked, case in enumerate(np.flatnonzero(~np.isfinite(states).all(axis=1)).tolist()):
            if keep_going is not None and looked % LOOK == 0 and not keep_going(0):
                break
            with noting() as found:
                try:
                    states[case] = self.start(cases.parameters_of(case), cases.initial_of(case))
                except SymbodyError as error:
                    results.status[case], results.messages[case] = Status.FAILED, str(error)
            results.findings[case] = deficiency_findings(found, self.model)
        begun = np.flatnonzero(np.isfinite(states).all(axis=1))
        return begun, states[begun]

    def start(self, parameters: Mapping[Expr, float], initial: Mapping[Expr, float]) -> Array:
        """Return the vector at the first instant: what is given, and zero or what the constraints demand."""
        return begin(self.model, parameters, initial, self.guess, float(self.instants[0]))

    def _record(
        self, results: Results, case: int, outcome: Outcome, parameters: Mapping[Expr, float]
    ) -> None:
        """Put in what the integrator gave for one case."""
        failure, size, reached = outcome.failure, len(self.model.state), len(outcome.states)
        if failure is not None and failure.kind == "interrupted":
            return
        is_early = outcome.end[0] < self.instants[-1]
        results.status[case] = (
            Status.FAILED if failure else Status.ENDED_BY_EVENT if is_early else Status.COMPLETED
        )
        results.messages[case] = self._reason(outcome, parameters)
        results.reached[case] = reached
        results.t_reached[case] = failure.t if failure else outcome.end[0]
        statistics = outcome.statistics
        results.counts[case] = (
            statistics.steps,
            statistics.rejected,
            statistics.evaluations,
            statistics.jacobians,
            statistics.is_stiff,
        )
        results.occurrences[case] = tuple(
            (event, when, np.array(state[:size])) for event, when, state in outcome.occurrences
        )
        if self.keeps_states:
            results.states[case, :reached, : outcome.states.shape[1]] = outcome.states
        with noting() as found:
            results.outputs[case, :, :reached] = self.values(
                list(self.outputs.values()), outcome.states[:, :size], self.instants[:reached], parameters
            )
        met = replace(outcome, deficiencies=outcome.deficiencies | found)
        integrated = Integrated(self.model, parameters, self.options, met, float(self.instants[0]))
        with noting():  # what the motion met is among the findings
            findings = findings_of(integrated)
        results.findings[case] = tuple(dict.fromkeys((*results.findings[case], *findings)))

    def _reason(self, outcome: Outcome, parameters: Mapping[Expr, float]) -> str:
        """Return why a motion failed, in the names of the model; nothing if it didn't."""
        if outcome.failure is None:
            return ""
        names = (*self.model.parameters, *self.model.damping)
        values = np.array([parameters[name] for name in names])
        return diagnosis(outcome.failure, outcome, self.model, values, self.options.method)

    def values(
        self, expressions: list[Expr], states: Array, instants: Array, parameters: Mapping[Expr, float]
    ) -> Array:
        """Return the values of expressions along a motion, a row for each."""
        if not expressions:
            return np.empty((0, len(instants)))
        function = self.model.function(expressions, tuple(parameters))
        return np.asarray(function(instants, *states.T, *parameters.values()))

    @property
    def width(self) -> int:
        """The length of the vector that is integrated."""
        return self.model.width


def _still(keep_going: Callable[[float], bool], case: int) -> Callable[[float], bool]:
    """Return what asks with the number of motions that are done, and not with the time of this one."""
    return lambda _: keep_going(case)
