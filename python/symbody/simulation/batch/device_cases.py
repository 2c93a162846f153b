"""Cases on a device: motions without trouble are recorded together, others are left to threads of this process."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from symbody.simulation.batch.case_arrays import Results, Status
from symbody.simulation.device.devices import prepared
from symbody.simulation.device.endings import REASONS, Column, Ending, Endings
from symbody.simulation.device.run_kernel import run_kernel
from symbody.simulation.integrate.integrated import Integrated
from symbody.simulation.integrate.notices import Finding, needs_a_look
from symbody.simulation.integrate.outcome import Outcome, Statistics
from symbody.simulation.integrate.task import KeepGoing, Task
from symbody.symbolic.numeric.deficiency import noting

from .cases import Cases

__all__ = ["Ended", "name_left", "run_on_device"]

Array = NDArray[np.float64]


class Ended(NamedTuple):
    """What remains to be done for cases that ran on a device.

    Attributes:
        alone: the motions that must be looked at one by one, and their cases.
        left: the cases that this process must integrate, and why.
    """

    alone: Iterator[tuple[int, Integrated]]
    left: dict[int, str]


def run_on_device(
    task: Task, cases: Cases, chosen: Sequence[int], states: Array, results: Results, keep_going: KeepGoing
) -> Ended:
    """Run cases on the device of a task, record those of which nothing is to be reported, and return the others.

    Args:
        task: what the cases share.
        cases: all cases.
        chosen: the numbers of those to run.
        states: the initial states of all cases.
        results: where the results of all cases are recorded.
        keep_going: called several times a second with the number of motions that have ended; False ends all.
    """
    device, kernel, loaded = prepared(task)
    numbers = np.array(chosen, dtype=np.intp)
    own = cases.subset(numbers)
    rows = np.empty((len(numbers), len(kernel.parameters)))
    for place, name in enumerate(kernel.parameters):
        rows[:, place] = own.parameters[name]
    found = run_kernel(device, loaded, kernel, task.options, task.instants, rows, states[numbers], keep_going)
    over = np.flatnonzero(found.is_over)
    are_recorded = _record_together(_Batch(task, own, numbers, found, over), results)
    alone = (
        (chosen[k], Integrated(task, own.parameters_of(k), _outcome_of(found, k, task)))
        for k in ([] if are_recorded else over.tolist())
    )
    left = np.flatnonzero(found.is_left).tolist()
    return Ended(alone, {chosen[k]: REASONS[Ending(int(found.status[k]))] for k in left})


def name_left(results: Results, left: dict[int, str]) -> None:
    """Add a finding to cases that were left to this process, and were none the worse for what the device met."""
    for case, reason in left.items():
        is_well = results.status[case] in (Status.COMPLETED, Status.ENDED_BY_EVENT)
        if is_well and not results.findings[case]:
            results.findings[case] = (Finding("left", reason),)


class _Batch(NamedTuple):
    """Motions that a device has integrated.

    Attributes:
        task: what they share.
        cases: their cases.
        numbers: the numbers of these in the results.
        found: how they ended.
        over: which of them ended without trouble.
    """

    task: Task
    cases: Cases
    numbers: NDArray[np.intp]
    found: Endings
    over: NDArray[np.intp]


def _record_together(batch: _Batch, results: Results) -> bool:
    """Record the motions that are over, all at once; return False if each of them must be looked at."""
    if needs_a_look(batch.task) or not _put_outputs(batch, results):
        return False
    task, _, numbers, found, over = batch
    at, counts = numbers[over], found.counts[over]
    reached = counts[:, Column.REACHED]
    is_early = counts[:, Column.STATUS] == Ending.ENDED_BY_EVENT
    results.status[at] = np.where(is_early, Status.ENDED_BY_EVENT, Status.COMPLETED)
    results.reached[at] = reached
    results.t_reached[at] = found.ends[over]
    results.counts[at] = np.column_stack(
        [counts[:, Column.STEPS : Column.EVALUATIONS + 1], np.zeros(len(over)), counts[:, Column.STIFF]]
    )
    if task.keeps_states:
        results.states[at] = _known(found.states[over], reached)
    for k in over[counts[:, Column.STIFF] > 0].tolist():
        results.findings[numbers[k]] = (Finding("stiff"),)
    for k in over[counts[:, Column.HAPPENED] > 0].tolist():
        size = len(task.model.state)
        results.occurrences[numbers[k]] = tuple(
            (event, t, np.array(state[:size]), np.empty((size, 0)))
            for event, t, state in _occurrences_of(found, k)
        )
    return True


def _known(values: Array, reached: NDArray[np.int64]) -> Array:
    """Return values along motions, shape (k, N, ...), NaN where these had ended."""
    values[np.arange(values.shape[1]) >= reached[:, np.newaxis]] = np.nan
    return values


def _put_outputs(batch: _Batch, results: Results) -> bool:
    """Evaluate the outputs of all motions together; return False if they meet a deficient linear system."""
    task, cases, numbers, found, over = batch
    if not task.outputs or not len(over):
        return True
    instants, size = len(task.instants), len(task.model.state)
    states = found.states[over, :, :size].reshape(-1, size)
    parameters = {name: np.repeat(values[over], instants) for name, values in cases.parameters.items()}
    function = task.model.function(list(task.outputs.values()), tuple(parameters))
    with noting() as met:
        values = function(np.tile(task.instants, len(over)), *states.T, *parameters.values())
    if met:
        return False
    rows = [np.broadcast_to(row, len(states)).reshape(len(over), instants) for row in values]
    reached = found.counts[over, Column.REACHED]
    for output, row in enumerate(rows):
        results.outputs[numbers[over], output] = _known(row.copy(), reached)
    return True


def _occurrences_of(found: Endings, k: int) -> list[tuple[int, float, list[float]]]:
    rows = found.events[k, : found.counts[k, Column.HAPPENED]]
    return [(int(row[0]), float(row[1]), row[2:].tolist()) for row in rows]


def _outcome_of(found: Endings, k: int, task: Task) -> Outcome:
    """Return the outcome of one motion that is over."""
    counts = found.counts[k]
    states, occurrences = found.states[k, : counts[Column.REACHED]], _occurrences_of(found, k)
    is_early = counts[Column.STATUS] == Ending.ENDED_BY_EVENT
    end = occurrences[-1][1:] if is_early else (float(task.instants[-1]), states[-1].tolist())
    steps, rejected, evaluations = map(int, counts[Column.STEPS : Column.EVALUATIONS + 1])
    is_stiff = bool(counts[Column.STIFF])
    return Outcome(states, occurrences, end, None, Statistics(steps, rejected, evaluations, 0, is_stiff))
