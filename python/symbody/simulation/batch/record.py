"""Records integrated motions in the results of a batch."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from symbody.simulation.batch.case_arrays import Results, Status
from symbody.simulation.integrate.diagnosis import diagnosis
from symbody.simulation.integrate.integrated import Integrated
from symbody.simulation.integrate.notices import findings_of
from symbody.simulation.integrate.outcome import FailureKind, with_deficiencies
from symbody.symbolic.numeric.deficiency import noting

__all__ = ["record"]


def record(results: Results, case: int, motion: Integrated) -> None:
    """Store the result of the integration of one case."""
    task, outcome = motion.task, motion.outcome
    failure, size, reached = outcome.failure, len(task.model.state), len(outcome.states)
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
    found = outcome.sensitivities
    none = np.empty((len(outcome.occurrences), size, 0))
    results.occurrences[case] = tuple(
        (event, when, np.array(state[:size]), slopes)
        for (event, when, state), slopes in zip(
            outcome.occurrences, none if found is None else found.occurrences, strict=True
        )
    )
    if found is not None and task.keeps_states:
        results.slopes[case, :reached] = found.states
    if task.keeps_states:
        results.states[case, :reached, : outcome.states.shape[1]] = outcome.states
    met = _put_outputs(results, case, motion) if task.outputs else motion
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
