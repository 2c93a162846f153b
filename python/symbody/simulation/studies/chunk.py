"""Chunks: some cases of a study, run and summed up."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from symbody.simulation.batch.case_arrays import Results, Status
from symbody.simulation.batch.case_tasks import case_tasks
from symbody.simulation.batch.cases import Cases
from symbody.simulation.batch.run_cases import run_cases
from symbody.simulation.integrate.notices import deficiency_findings
from symbody.simulation.integrate.tally import Tally
from symbody.simulation.integrate.task import KeepGoing, Task
from symbody.simulation.model.model import DAMPING
from symbody.symbolic import Expr
from symbody.symbolic.numeric.deficiency import noting

from .measures.measure import Course, Crossings
from .plan import Plan
from .statistics.statistic import Partial

__all__ = ["Chunk", "run_chunk", "summed_up"]

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Chunk:
    """The results of k cases of a study.

    Attributes:
        status: how each case ended, a `Status`, shape (k,).
        t_reached: the last known instant of each case, shape (k,).
        messages: why cases failed, by their number in the chunk.
        tally: what a user should know of cases, by their number in the study, counted.
        values: the numbers of the measures, shape (k, columns); NaN for cases that failed.
        partials: the partial result of each statistic.
        histories: the outputs, shape (k, outputs, N), if they are kept.
    """

    status: NDArray[np.int8]
    t_reached: Array
    messages: Mapping[int, str]
    tally: Tally
    values: Array
    partials: tuple[Partial, ...]
    histories: Array | None


def run_chunk(plan: Plan, cases: Cases, first: int, threads: int, keep_going: KeepGoing) -> Chunk | None:
    """Run some cases and sum them up; return None if `keep_going` ended them.

    Args:
        plan: what the cases share.
        cases: the cases.
        first: the number of the first of them in the study.
        threads: how many run at a time.
        keep_going: called from time to time with the number of finished cases; False ends all of them.
    """
    return summed_up(plan, cases, first, run_cases(plan.task, cases, threads, keep_going))


def summed_up(plan: Plan, cases: Cases, first: int, results: Results) -> Chunk | None:
    """Sum up some cases; return None if not all of them were run.

    Args:
        plan: what the cases share.
        cases: the cases.
        first: the number of the first of them in the study.
        results: their results.
    """
    if len(results.missing):
        return None
    with noting() as found:
        values = _Motions(plan, cases, results)
        outputs, columns = values.outputs(), values.columns()
    tally = Tally()
    for case, each in enumerate(results.findings):
        own = each if case else tuple(dict.fromkeys((*each, *deficiency_findings(found, plan.task.model))))
        if own:
            tally.add(first + case, own)
    failed = np.flatnonzero(results.status == Status.FAILED).tolist()
    return Chunk(
        results.status,
        results.t_reached,
        {case: str(results.messages[case]) for case in failed},
        tally,
        columns,
        tuple(statistic.of(outputs, first) for statistic in plan.statistics),
        outputs if plan.keeps_histories else None,
    )


class _Motions:
    """The motions of a chunk as arrays, in which expressions are evaluated for all cases at once.

    Args:
        plan: the plan.
        cases: the cases.
        results: their states at the instants, and their events.
    """

    def __init__(self, plan: Plan, cases: Cases, results: Results) -> None:
        self._plan, self._task, self._results = plan, plan.task, results
        self._size = len(plan.task.model.state)
        self._count, self._instants = cases.count, len(plan.task.instants)
        self._is_good = results.status != Status.FAILED
        self._tasks = case_tasks(plan.task, cases, results)
        self._parameters = _with_damping(self._tasks, cases, results.states[:, 0, : self._size])
        self._events = results.occurrences.table
        self._end_t, self._end_states = self._ends()

    def outputs(self) -> Array:
        """Return the outputs, shape (k, outputs, N); NaN after the end of a motion."""
        return self._along([*self._plan.outputs.values()])

    def columns(self) -> Array:
        """Return the numbers of all measures, shape (k, columns)."""
        plan, measures = self._plan, self._plan.measures
        if not measures:
            return np.empty((self._count, 0))
        expressions = [measure.expression for measure in measures.values()]
        along, end = self._along(expressions), self._at_end(expressions)
        totals = self._at_end([*plan.integrals.values()])
        integrals = dict(zip(plan.integrals, totals, strict=True))
        unknown = np.full(self._count, np.nan)
        found: list[Array] = []
        for k, (name, measure) in enumerate(measures.items()):
            crossings = self._crossings(measure.expression, plan.event_ranges[name])
            course = Course(
                self._task.instants,
                along[:, k],
                self._end_t,
                end[k],
                integrals.get(name, unknown),
                crossings,
            )
            found += measure.of(course)
        return np.where(self._is_good[:, np.newaxis], np.array(found).T, np.nan)

    def _along(self, expressions: list[Expr]) -> Array:
        """Return expressions at all instants, shape (k, expressions, N)."""
        count, n = self._count, self._instants
        states = self._results.states[:, :, : self._size].reshape(count * n, self._size)
        case, t = np.repeat(np.arange(count), n), np.tile(self._task.instants, count)
        values = self._values(expressions, states, t, case)
        return np.moveaxis(values.reshape(len(expressions), count, n), 0, 1)

    def _at_end(self, expressions: list[Expr]) -> Array:
        """Return expressions where each motion ended, shape (expressions, k)."""
        return self._values(expressions, self._end_states, self._end_t, np.arange(self._count))

    def _ends(self) -> tuple[Array, Array]:
        """Return the instants and the states where the motions ended: at the last instant, or a terminal event."""
        t = np.full(self._count, self._task.instants[-1])
        states = self._results.states[:, -1, : self._size].copy()
        ended = self._results.status == Status.ENDED_BY_EVENT
        last = self._events.last(np.flatnonzero(ended))
        t[ended], states[ended] = self._events.t[last], self._events.state[last, : self._size]
        return t, states

    def _crossings(self, expression: Expr, own: range) -> Crossings:
        """Return the occurrences of the events of one measure."""
        events = self._events
        chosen = np.flatnonzero((events.event >= own.start) & (events.event < own.stop))
        case, t = events.case[chosen], events.t[chosen]
        (values,) = self._values([expression], events.state[chosen, : self._size], t, case)
        return Crossings(case, events.event[chosen] - own.start, t, values)

    def _values(self, expressions: list[Expr], states: Array, t: Array, case: NDArray[np.intp]) -> Array:
        """Return expressions at states, shape (expressions, points); NaN at states that are not known."""
        values = np.full((len(expressions), len(t)), np.nan)
        is_known = np.isfinite(states).all(axis=1)
        if not expressions:
            return values
        for task in dict.fromkeys(self._tasks):
            own = is_known & np.array([each is task for each in self._tasks])[case]
            if not own.any():
                continue
            known = slice(None) if own.all() else own
            function = task.model.function(expressions, tuple(self._parameters))
            given = [values[case[known]] for values in self._parameters.values()]
            values[:, known] = np.asarray(function(t[known], *states[known].T, *given))
        return values


def _with_damping(tasks: list[Task], cases: Cases, starts: Array) -> Mapping[Expr, Array]:
    """Return the parameters, with those of Baumgarte's stabilisation if it is used; NaN for cases without a start."""
    if not any(task.model.is_stabilized for task in tasks):
        return cases.parameters
    rows = np.full((cases.count, len(DAMPING)), np.nan)
    for case in np.flatnonzero(np.isfinite(starts).all(axis=1)).tolist():
        rows[case] = [*tasks[case].damping_of(cases.parameters_of(case), starts[case]).values()]
    return {**cases.parameters, **dict(zip(DAMPING, rows.T, strict=True))}
