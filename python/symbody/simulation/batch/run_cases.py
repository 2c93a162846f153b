"""Runs some cases of a task: their initial states, the results of their integration, and why some of them failed."""

from __future__ import annotations

from collections.abc import Mapping
from concurrent.futures import ThreadPoolExecutor

import numpy as np
from numpy.typing import NDArray

from symbody.errors import SymbodyError
from symbody.simulation.batch.case_arrays import Results, Status
from symbody.simulation.given.values import finite_number
from symbody.simulation.integrate.initial_state import initial_slopes, initial_state, initial_states
from symbody.simulation.integrate.integrated import run_motions
from symbody.simulation.integrate.notices import deficiency_findings
from symbody.simulation.integrate.stopped_start import stopped_starts
from symbody.simulation.integrate.task import KeepGoing, Task
from symbody.simulation.integrate.with_sensitivities import beside_sensitivities
from symbody.symbolic.numeric.deficiency import noting

from .case_tasks import Reduced, own_task
from .cases import Cases
from .record_motions import record_motions

__all__ = ["empty_results", "run_cases"]

Array = NDArray[np.float64]

LOOK = 32
"""The number of initial states between two checks for Ctrl-C."""

WORTH_THREADS = 2048
"""The number of cases from which it pays that several threads solve for their initial states."""


def empty_results(task: Task, cases: int) -> Results:
    """Return results of cases that were not run."""
    instants = len(task.instants)
    kept = instants if task.keeps_states else 0
    slopes = (len(task.model.state), len(task.by))
    return Results.empty(cases, instants, kept, task.model.width, len(task.outputs), slopes)


def run_cases(task: Task, cases: Cases, threads: int = 1, keep_going: KeepGoing = lambda _: True) -> Results:
    """Run some cases in native threads; the results of a case that fails say why.

    Args:
        task: what the cases share.
        cases: the cases.
        threads: how many run at a time.
        keep_going: called from time to time with the number of finished cases; False ends all of them.
    """
    results = empty_results(task, cases.count)
    tasks, states, slopes = _begun(task, cases, results, threads, keep_going)
    finished = 0

    def goes_on(done: float) -> bool:
        return keep_going(finished + done)

    for each, begun in _grouped(tasks).items():
        chosen = _unstopped(each, begun, cases, states, results)
        if not chosen:
            continue
        parameters = cases.subset(np.array(chosen)).parameters
        starts = states[chosen]
        if each.variation is not None:
            starts = np.array(
                [
                    beside_sensitivities(states[k], slopes[k], each.variation, cases.parameters_of(k))
                    for k in chosen
                ]
            )
        record_motions(results, np.array(chosen), run_motions(each, parameters, starts, threads, goes_on))
        finished += len(chosen)
    return results


def _unstopped(task: Task, begun: list[int], cases: Cases, states: Array, results: Results) -> list[int]:
    """Return the cases whose starts no stop forbids; record why the others fail.

    Args:
        task: what these cases share.
        begun: their numbers.
        cases: all cases.
        states: the initial states of all cases.
        results: where to record it.
    """
    if not task.events:
        return begun
    forbidden = stopped_starts(task, cases.subset(np.array(begun)).parameters, states[begun])
    for place, message in forbidden.items():
        results.status[begun[place]], results.messages[begun[place]] = Status.FAILED, message
    return [case for place, case in enumerate(begun) if place not in forbidden]


def _grouped(tasks: Mapping[int, Task]) -> dict[Task, list[int]]:
    """Return the cases of each task: parameters decide which constraints are redundant."""
    kinds = set(tasks.values())
    if len(kinds) == 1:  # the usual case
        return {kinds.pop(): list(tasks)}
    groups: dict[Task, list[int]] = {}
    for case, task in tasks.items():
        groups.setdefault(task, []).append(case)
    return groups


def _begun(
    task: Task, cases: Cases, results: Results, threads: int, keep_going: KeepGoing
) -> tuple[dict[int, Task], Array, dict[int, Array]]:
    """Return the tasks of the cases that can start, all initial states, and derivatives; record why others fail.

    Args:
        task: what the cases share.
        cases: the cases.
        results: where to record it.
        threads: how many states are solved for at a time.
        keep_going: called from time to time; False ends the search.
    """
    states = _initial_states(task, cases, threads)
    states[~_have_finite_parameters(cases)] = np.nan
    tasks = dict.fromkeys(np.flatnonzero(np.isfinite(states).all(axis=1)).tolist(), task)
    slopes = {case: initial_slopes(task, {}, {}, states[case]) for case in tasks} if task.by else {}
    reduced = Reduced()
    for looked, case in enumerate(np.flatnonzero(~np.isfinite(states).all(axis=1)).tolist()):
        if looked % LOOK == 0 and not keep_going(0):
            break
        with noting() as found:
            try:
                parameters = cases.parameters_of(case)
                for name, value in parameters.items():
                    finite_number(name, value, "simulate, parameters")
                states[case] = initial_state(task, parameters, cases.initial_of(case))
                if task.by:
                    slopes[case] = initial_slopes(task, parameters, cases.initial_of(case), states[case])
                tasks[case] = own_task(task, parameters, states[case], reduced)
            except SymbodyError as error:
                results.status[case], results.messages[case] = Status.FAILED, str(error)
        results.findings[case] = deficiency_findings(found, task.model)
    return tasks, states, slopes


def _have_finite_parameters(cases: Cases) -> NDArray[np.bool_]:
    finite = np.ones(cases.count, dtype=bool)
    for column in cases.parameters.values():
        finite &= np.isfinite(np.asarray(column, dtype=np.float64))
    return finite


def _initial_states(task: Task, cases: Cases, threads: int) -> Array:
    """Return the initial states that need no further look, one row each; NaN where `initial_state` solves for them.

    A state does not depend on the other cases, so each thread solves for a part of them. The first case goes ahead:
    what it compiles is there for all.
    """
    model = task.model
    is_constrained = bool(model.constraints) or model.system.has_quasi_velocities
    if task.by and is_constrained:
        return np.full((cases.count, model.width), np.nan)
    if threads == 1 or cases.count < WORTH_THREADS or not is_constrained:
        return _states_of(task, cases)
    parts = [np.arange(1), *np.array_split(np.arange(1, cases.count), threads)]
    first, *others = (cases.subset(part) for part in parts)
    begun = _states_of(task, first)
    with ThreadPoolExecutor(threads) as pool:
        return np.concatenate([begun, *pool.map(lambda part: _states_of(task, part), others)])


def _states_of(task: Task, cases: Cases) -> Array:
    return initial_states(task, cases.parameters, cases.initial, cases.count)
