"""Stores the results of motions: in columns those of which nothing is to be told, and the others one by one."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from symbody.simulation.batch.case_arrays import Results, Status
from symbody.simulation.integrate.diagnosis import diagnosis
from symbody.simulation.integrate.integrated import Integrated, Motions
from symbody.simulation.integrate.notices import findings_of
from symbody.simulation.integrate.occurrences import Occurrences
from symbody.simulation.integrate.outcome import FailureKind, with_deficiencies
from symbody.simulation.integrate.unremarkable import unremarkable_motions
from symbody.symbolic.numeric.deficiency import noting

__all__ = ["record_motions"]

Indices = NDArray[np.intp]

POINTS = 2**15
"""The states at which outputs are evaluated at a time: they stay in the cache."""


def record_motions(results: Results, cases: Indices, motions: Motions) -> None:
    """Store the results of motions.

    Args:
        results: where to store them.
        cases: the number of the case of each motion, increasing.
        motions: the motions.
    """
    unremarkable = unremarkable_motions(motions)
    for place, motion in motions.among(np.flatnonzero(~unremarkable).tolist()):
        if motion is not None:
            _record(results, int(cases[place]), motion)
    places = np.flatnonzero(unremarkable)
    if places.size:
        _record_columns(results, cases, motions, places)
        if motions.task.outputs:
            _put_columns_of_outputs(results, cases, motions, places)


def _record_columns(results: Results, cases: Indices, motions: Motions, places: Indices) -> None:
    """Store the results of motions that reached the last instant or a terminal event, and have no findings.

    Args:
        results: where to store them.
        cases: the number of the case of each motion.
        motions: the motions.
        places: which of them.
    """
    chosen = cases[places]
    results.status[chosen] = np.where(motions.is_whole[places], Status.COMPLETED, Status.ENDED_BY_EVENT)
    results.reached[chosen] = motions.reached[places]
    results.t_reached[chosen] = motions.end_t[places]
    results.counts[chosen] = motions.counts[places]
    if motions.task.keeps_states:
        results.states[chosen] = motions.states[places]
    results.occurrences.add(motions.occurrences.of_some(cases, places, len(motions.task.model.state)))


def _put_columns_of_outputs(results: Results, cases: Indices, motions: Motions, places: Indices) -> None:
    """Store the outputs of motions; where linear systems in them are deficient, each case gets its own findings."""
    task, size = motions.task, max(1, POINTS // len(motions.task.instants))
    expressions, width = list(task.outputs.values()), len(task.model.state)
    for own in np.split(places, range(size, len(places), size)):
        columns = {name: np.broadcast_to(c, len(cases))[own] for name, c in motions.columns.items()}
        with noting() as found:
            results.outputs[cases[own]] = task.values_of_many(
                expressions, motions.states[own, :, :width], motions.reached[own], columns
            )
        if found:
            for place, motion in motions.among(own.tolist()):
                if motion is not None:
                    _put_outputs_and_findings(results, int(cases[place]), motion)


def _record(results: Results, case: int, motion: Integrated) -> None:
    """Store the result of the integration of one case."""
    task, outcome = motion.task, motion.outcome
    failure, reached = outcome.failure, len(outcome.states)
    if failure is not None and failure.kind is FailureKind.INTERRUPTED:
        return
    is_early = outcome.end[0] < task.instants[-1]
    results.status[case] = (
        Status.FAILED if failure else Status.ENDED_BY_EVENT if is_early else Status.COMPLETED
    )
    results.messages[case] = diagnosis(motion) if failure else ""
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
    results.occurrences.add(_occurrences(case, motion, len(task.model.state)))
    found = outcome.sensitivities
    if found is not None and task.keeps_states:
        results.slopes[case, :reached] = found.states
    if task.keeps_states:
        results.states[case, :reached, : outcome.states.shape[1]] = outcome.states
    _put_outputs_and_findings(results, case, motion)


def _occurrences(case: int, motion: Integrated, size: int) -> Occurrences:
    """Return the events of one case as columns."""
    given, found = motion.outcome.occurrences, motion.outcome.sensitivities
    events = np.array([event for event, _, _ in given], dtype=np.int64)
    t = np.array([t for _, t, _ in given], dtype=np.float64)
    width = motion.task.model.width
    unknown = [np.nan] * (width - size)  # the work, if the method has not integrated it
    rows = [[*state, *unknown][:width] for *_, state in given]
    states = np.array(rows, dtype=np.float64).reshape(-1, width)
    slopes = np.empty((len(given), size, 0)) if found is None else found.occurrences
    return Occurrences(np.full(len(given), case, dtype=np.int64), events, t, states, slopes)


def _put_outputs_and_findings(results: Results, case: int, motion: Integrated) -> None:
    met = _put_outputs(results, case, motion) if motion.task.outputs else motion
    with noting():  # what the motion met is already in its findings
        findings = findings_of(met)
    results.findings[case] = tuple(dict.fromkeys((*results.findings[case], *findings)))


def _put_outputs(results: Results, case: int, motion: Integrated) -> Integrated:
    """Store the outputs of one case; return the motion with the deficient linear systems that they met."""
    task, states = motion.task, motion.outcome.states
    reached, size = len(states), len(task.model.state)
    with noting() as found:
        results.outputs[case, :, :reached] = task.values(
            list(task.outputs.values()), states[:, :size], task.instants[:reached], motion.parameters
        )
    return replace(motion, outcome=with_deficiencies(motion.outcome, found))
