"""Studies: very many motions, of which only numbers and statistics are kept."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass, replace
from math import inf
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike

from symbody.dynamics import Equations
from symbody.errors import ArgumentError, SimulationError, notify
from symbody.simulation.batch.case_arrays import Status
from symbody.simulation.batch.case_check import check_cases
from symbody.simulation.batch.cases import Cases, Values, cases_of
from symbody.simulation.batch.problem_digest import problem_digest
from symbody.simulation.batch.results_file import digest
from symbody.simulation.batch.workers import MEMORY, checked_workforce, core_count
from symbody.simulation.given.event import Event
from symbody.simulation.integrate.outputs_and_events import check_observed, given_events, given_outputs
from symbody.simulation.integrate.task_of import task_of, warn_of_odd_values
from symbody.simulation.terminal.interruption import Interruption
from symbody.simulation.terminal.progress import progress_bar
from symbody.symbolic import Expr, ExprLike
from symbody.symbolic.given.arguments import described, with_known_names

from .accumulation import Accumulation
from .flight import Finished, run_by_executor, run_in_threads
from .integrals import with_integrals
from .measures.measure import Measure
from .plan import PLACE, Plan, all_events, checked_measures, checked_statistics, study_instants
from .statistics.extremes import extremes
from .statistics.moments import moments
from .statistics.statistic import Statistic
from .study_file import StudyFile
from .study_results import Study

__all__ = ["study"]

FEWEST, MOST, CHUNKS = 256, 4096, 64
"""The least cases of a chunk (enough for lock-step), the most (to lose), and in between the number of chunks."""

IN_FLIGHT = 256 * 2**20
"""The bytes of results that are at the workers of an executor, or on their way."""


@with_known_names
def study(
    eqs: Equations,
    parameters: Values | None = None,
    initial: Values | None = None,
    t: tuple[float, float] | ArrayLike = (0.0, 10.0),
    *,
    cases: Values | None = None,
    measures: Mapping[str, Measure] | None = None,
    outputs: Mapping[str, ExprLike] | None = None,
    statistics: Sequence[Statistic] | None = None,
    histories: bool = False,
    units: Mapping[str, str] | None = None,
    inputs: Mapping[Expr, ExprLike] | None = None,
    method: str = "auto",
    rtol: float = 1e-8,
    atol: float = 1e-10,
    events: Sequence[Event] | None = None,
    constraints: str | tuple[float, float] = "projection",
    guess: Mapping[Expr, float] | None = None,
    max_step: float = inf,
    executor: Executor | None = None,
    threads: int | None = None,
    chunk: int | None = None,
    path: str | os.PathLike[str] | None = None,
    progress: bool | None = None,
) -> Study:
    """Return measures and statistics of very many motions, whose states are not kept.

    The cases run in chunks, in the lanes of vectors as in `simulate_many`. Results do not depend on the workers, or on
    the order in which they finish, to the last bit. Memory is needed for the measures of all cases and for the chunks
    in flight. After Ctrl-C, the finished chunks are returned; with a path, the same call continues.

    Args:
        eqs: the equations of motion.
        parameters: the values of the parameters, as in `simulate_many`.
        initial: the values of coordinates, their rates, speeds or states at the first instant.
        t: the first and the last instant (1001 instants for outputs), or all instants, in s.
        cases: values of parameters and initial values together: a `sample`, or a `grid`.
        measures: what sums up each motion, by name: functions of `symbody.measures`, which the integrator computes.
        outputs: expressions whose statistics over all cases are computed at all instants, by name.
        statistics: functions of `symbody.statistics`; by default moments and extremes.
        histories: whether the outputs of all cases are kept as well, in the file.
        units: the units of measures, outputs and parameters by name, for the file and for plots.
        inputs: expressions of time, state and parameters for the input functions of time.
        method: the method of integration; see `simulate`.
        rtol: the tolerance of the error of a step, relative to the state.
        atol: the absolute tolerance of the error of a step.
        events: events that end motions, if they are terminal.
        constraints: how constraints are enforced; see `simulate`.
        guess: where to look for initial states that satisfy the constraints.
        max_step: the longest step, in s.
        executor: an executor whose workers run the chunks, as in `simulate_many`; chunks that workers lose are run
            again, and a bounded number is in flight.
        threads: the number of threads without an executor; by default one for each core.
        chunk: the number of cases of a chunk; by default 256 to 4096, fewer if they need much memory.
        path: a folder ``.zarr``, to which each chunk is appended. If it exists, only missing chunks are run.
        progress: whether to show a progress bar; by default if messages go to a terminal.

    Raises:
        ArgumentError: an argument has the wrong kind.
        ParameterError: a value is missing, has an unknown key, or rows differ in length.
        ResultsError: the file can't be written, or holds another study.
        SimulationError: an option is unknown, the executor runs nothing, or a package is missing.

    >>> import symbody as sb
    >>> x, (m, k) = sb.functions_of_time("x"), sb.symbols("m k")
    >>> cart = sb.Body(sb.translate(x, 0, 0), m)
    >>> spring = sb.Force(sb.ground, -k * x, 0, 0, at=cart.center_of_mass, on=cart)
    >>> oscillator = sb.newton_euler(sb.System([cart], [spring], coordinates=[x]))
    >>> cases = sb.sample({k: ("uniform", 1, 4)}, 512)
    >>> peak = sb.measures.maximum(sb.time_derivative(x))
    >>> found = sb.study(oscillator, {m: 1}, {x: 0.1}, t=(0, 10), cases=cases, measures={"peak": peak})
    >>> found
    Study(512 cases, 2 numbers each)
    >>> bool(abs(found["peak"] - 0.1 * cases[k] ** 0.5).max() < 1e-7)
    True
    """
    workforce = checked_workforce(
        PLACE, executor, core_count() if threads is None else threads, path, "study.zarr"
    )
    named = checked_measures(measures)
    given, own = given_outputs(outputs, PLACE), given_events(events, PLACE)
    kinds = checked_statistics((moments(), extremes()) if statistics is None else statistics)
    _check_kept(named, given, histories=histories, path=path)
    all_cases = cases_of(parameters, initial, cases, PLACE)
    with_states, states = with_integrals(
        eqs, [each.integrand for each in named.values() if each.integrand is not None]
    )
    task = task_of(
        with_states,
        all_cases.parameters,
        t,
        inputs=inputs,
        method=method,
        rtol=rtol,
        atol=atol,
        outputs=None,
        events=all_events(own, named),
        constraints=constraints,
        guess=guess,
        max_step=max_step,
        where=PLACE,
    )
    task = replace(task, instants=study_instants(t, named, has_outputs=bool(given)))
    integrals = [name for name, each in named.items() if each.integrand is not None]
    plan = Plan(
        task,
        named,
        dict(zip(integrals, states, strict=True)),
        given,
        kinds if given else (),
        histories,
        len(own),
    )
    _check_names(plan, all_cases, units)
    check_observed(task.model, given, task.events, PLACE, _expressions(named))
    check_cases(plan.with_names, all_cases, PLACE)
    warn_of_odd_values(plan.with_names, all_cases.parameters, PLACE)
    numbers = (len(task.instants) + task.trail) * (task.model.width + len(plan.expressions))
    size = _chunk_size(numbers, all_cases.count, chunk)
    file = None if path is None else _file(Path(path), plan, all_cases, size, units or {})
    found = Accumulation.begun(plan, all_cases.count, size, file)
    reason = _Run(plan, all_cases, found).run_missing(*workforce, progress=progress)
    result = Study(plan, all_cases, found, dict(units or {}))
    _warn(result, reason, has_path=path is not None)
    return result


@dataclass(frozen=True, eq=False)
class _Run:
    """A study in progress."""

    plan: Plan
    cases: Cases
    found: Accumulation

    def run_missing(self, executor: Executor | None, threads: int, *, progress: bool | None) -> str:
        """Run the missing chunks; return why some of them were not run."""
        found, finished = self.found, self.found.done
        with (
            Interruption() as interruption,
            progress_bar(PLACE, self.cases.count, is_shown=progress) as show,
        ):

            def keep_going(done: float) -> bool:
                show(finished + done)
                return not interruption.is_asked_for

            numbers, size = found.missing, found.size
            if executor is None:
                parts = run_in_threads(self.plan, self.cases, size, numbers, threads, keep_going)
            else:
                parts = run_by_executor(
                    self.plan,
                    self.cases,
                    size,
                    numbers,
                    executor,
                    self._most_in_flight(),
                    found.oldest,
                    keep_going,
                )
            reason = self._take(parts)
            show(found.done)
        return "interrupted" if interruption.is_asked_for else reason

    def _most_in_flight(self) -> int:
        """Return how many chunks may be at the workers."""
        plan = self.plan
        over_time, size = len(plan.outputs) * len(plan.task.instants), self.found.size
        numbers = size * (len(plan.columns) + over_time * plan.keeps_histories)
        numbers += over_time * sum(statistic.numbers for statistic in plan.statistics)
        return int(np.clip(IN_FLIGHT // (8 * max(1, numbers)), 4, 1024))

    def _take(self, parts: Iterator[Finished]) -> str:
        """Take all chunks; if the executor fails, keep those that are there."""
        found = self.found
        try:
            for number, chunk in parts:
                found.put(number, chunk)
        except SimulationError as error:
            if not found.done:
                raise
            return str(error)
        finally:
            found.commit()
        if found.file is not None and not found.missing:
            found.file.finish(found.over_time())
        return ""


def _chunk_size(row: int, count: int, given: object) -> int:
    """Return the number of cases of a chunk: it depends on the study alone, as merging in chunks does.

    Args:
        row: the numbers of states and of values that one case needs.
        count: the number of cases.
        given: what the user asks for.
    """
    if given is None:
        size = int(np.clip(-(-count // CHUNKS), FEWEST, MOST))
        return max(1, min(size, MEMORY // (8 * row)))
    if isinstance(given, bool) or not isinstance(given, int) or given < 1:
        raise ArgumentError(f"{PLACE}: chunk={described(given)}; expected a whole number from 1")
    return given


def _file(path: Path, plan: Plan, cases: Cases, size: int, units: Mapping[str, str]) -> StudyFile:
    """Return the file of a study, made or checked.

    Args:
        path: its path.
        plan: what is computed.
        cases: all cases.
        size: the number of cases of a chunk.
        units: the units, by name.
    """
    problem = problem_digest(plan.with_names, cases)
    problem["the measures"] = digest(f"{name} {measure}" for name, measure in plan.measures.items())
    problem["the statistics"] = digest([*map(repr, plan.statistics), repr(plan.keeps_histories)])
    problem["the chunks"] = digest([str(size)])
    file = StudyFile(path, plan, cases, size, problem, units)
    file.open()
    return file


def _expressions(measures: Mapping[str, Measure]) -> dict[str, Expr]:
    return {name: measure.expression for name, measure in measures.items()}


def _check_kept(
    measures: Mapping[str, Measure], outputs: Mapping[str, Expr], *, histories: bool, path: object
) -> None:
    """Check that something is computed, and that histories have a place."""
    if not measures and not outputs:
        raise ArgumentError(
            f"{PLACE}: nothing to compute; give measures={{'peak': measures.maximum(x)}} or outputs={{'x': x}}"
        )
    if histories and not outputs:
        raise ArgumentError(f"{PLACE}: histories=True, but there are no outputs; give outputs={{'x': x}}")
    if histories and path is None:
        raise ArgumentError(
            f"{PLACE}: histories=True needs a path, such as path='study.zarr'; simulate_many keeps motions in memory"
        )


def _check_names(plan: Plan, cases: Cases, units: object) -> None:
    """Check that measures, outputs and parameters have names of their own, which a file can have."""
    if units is not None and not (
        isinstance(units, Mapping) and all(isinstance(each, str) for pair in units.items() for each in pair)
    ):
        raise ArgumentError(
            f"{PLACE}, units: {described(units)}; expected names and units, such as {{'peak': 'm/s'}}"
        )
    given = [*map(str, cases.parameters), *(f"initial_{name}" for name in cases.initial)]
    taken = [*given, "case", "t", "status", "t_reached", "message", "progress"]
    for name in (*plan.columns, *plan.outputs):
        if name in taken or "/" in name or not name:
            raise ArgumentError(
                f"{PLACE}: the name {name!r} of a measure or an output is taken, or contains '/'; rename it"
            )
        taken.append(name)


def _warn(result: Study, reason: str, *, has_path: bool) -> None:
    """Warn of failures, of gaps, and of what the cases have found."""
    failed, missing = np.flatnonzero(result.found.status == Status.FAILED), len(result.not_run)
    if failed.size:
        first = int(failed[0])
        values = {**result.cases.parameters_of(first), **result.cases.initial_of(first)}
        listed = ", ".join(f"{name} = {value:.6g}" for name, value in values.items())
        why = result.found.messages.get(first, "").rstrip(".")
        notify(
            f"{PLACE}: {failed.size} of {len(result)} motions failed; the first is case {first} ({listed}): {why}. All "
            "are in .failures; their measures are NaN, and statistics over time count them up to where they ended"
        )
    if missing:
        advice = (
            "the same call goes on with the rest"
            if has_path
            else "give a path to keep results for another call"
        )
        notify(
            f"{PLACE}: {missing} of {len(result)} motions were not run ({reason.removeprefix(f'{PLACE}: ')}); they are "
            f"in .not_run, their measures are NaN, and statistics over time leave them out; {advice}"
        )
    for text in result.found.tally.notices(len(result), PLACE):
        notify(text)
