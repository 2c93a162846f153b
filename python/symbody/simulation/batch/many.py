"""Many motions of one model, over parameters and initial states: on all cores or on many machines."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass, field
from math import inf
from pathlib import Path
from time import monotonic

from numpy.typing import ArrayLike

from symbody.dynamics import Equations
from symbody.errors import ArgumentError, ResultsError, SimulationError, notify
from symbody.simulation.batch.case_arrays import Results
from symbody.simulation.device.devices import on_device
from symbody.simulation.given.event import Event
from symbody.simulation.integrate.tally import notices_of_batch
from symbody.simulation.integrate.task import Task
from symbody.simulation.integrate.task_of import task_of, warn_of_odd_parameters
from symbody.simulation.terminal.interruption import Interruption
from symbody.simulation.terminal.progress import progress_bar
from symbody.symbolic import Expr, ExprLike
from symbody.symbolic.given.arguments import with_known_names

from .case_check import check_cases
from .cases import PLACE, Cases, Values, cases_of
from .problem_digest import problem_digest
from .results_file import ResultsFile
from .run_cases import empty_results
from .runs import Runs
from .workers import Part, check_one_workforce, checked_workforce, core_count, run_by_executor, run_in_threads

SAVE_EVERY = 10.0
"""The time between two saves, in s: an accident costs no more work than that."""

PREFIX = f"{PLACE}: "

SAVE_PAUSE = 20.0
"""The shortest pause between saves, in units of the time that a save takes."""


@with_known_names
def simulate_many(
    eqs: Equations,
    parameters: Values | None = None,
    initial: Values | None = None,
    t: tuple[float, float] | ArrayLike = (0.0, 10.0),
    *,
    cases: Values | None = None,
    inputs: Mapping[Expr, ExprLike] | None = None,
    method: str = "auto",
    rtol: float = 1e-8,
    atol: float = 1e-10,
    outputs: Mapping[str, ExprLike] | None = None,
    events: Sequence[Event] | None = None,
    constraints: str | tuple[float, float] = "projection",
    guess: Mapping[Expr, float] | None = None,
    max_step: float = inf,
    sensitivities: Sequence[Expr] | None = None,
    executor: Executor | None = None,
    threads: int | None = None,
    device: str | None = None,
    path: str | os.PathLike[str] | None = None,
    progress: bool | None = None,
    keep_states: bool = True,
) -> Runs:
    """Return many motions of a system, one for each set of parameters and initial values.

    A value is a number, which holds for all motions, or a row of numbers with one for each; all rows have the same
    length. A list of dictionaries, one for each motion, is the same as a dictionary of rows. A motion that fails does
    not stop the others: it is listed in the failures of the runs, with its parameters. After Ctrl-C, the finished
    motions are returned. Many motions by explicit methods are integrated in lock-step, several in a vector of the
    processor; their results are those of single motions, to the last bit.

    Args:
        eqs: the equations of motion.
        parameters: the values of the parameters.
        initial: the values of coordinates, their rates, speeds or states at the first instant.
        t: the first and the last instant (1001 evenly spaced instants), or all instants, in s.
        cases: values of parameters and initial values together, such as a `grid` of all combinations.
        inputs: expressions of time, state and parameters for the input functions of time.
        method: the method of integration; see `simulate`.
        rtol: the tolerance of the error of a step, relative to the state.
        atol: the absolute tolerance of the error of a step.
        outputs: expressions to evaluate at all instants, by name.
        events: the events to watch; a terminal one ends the motion of its case.
        constraints: how constraints are enforced; see `simulate`.
        guess: where to look for initial states that satisfy the constraints.
        max_step: the longest step, in s.
        sensitivities: parameters, and coordinates, speeds and states for their initial values, by which all motions are
            differentiated; `Runs.sensitivity` has the derivatives.
        executor: an executor whose workers run the motions: one of `concurrent.futures`, or dask's
            ``client.get_executor()``. By default, native threads of this process run them.
        threads: the number of these threads; by default one for each core.
        device: ``"cuda"`` for a graphics processor of NVIDIA (``pip install "symbody[cuda]"``): one motion a thread, by
            an explicit method. Motions that meet trouble there are integrated by threads of this process.
        path: a file ``.npz`` for the results, which is updated regularly. If it exists, only missing cases are run.
        progress: whether to show a progress bar; by default if messages go to a terminal.
        keep_states: whether the states are results, or only the outputs, which need less memory.

    Raises:
        ParameterError: a value is missing, has an unknown key, or rows differ in length.
        ResultsError: the file can't be written, or holds the results of another problem.
        SimulationError: an option is unknown, or the executor runs nothing.

    >>> from symbody import Body, Point, System, Vector, functions_of_time, ground, lagrange_equations, rotate, symbols
    >>> theta, (m, l, g) = functions_of_time("theta"), symbols("m l g")
    >>> bob = Body(Point(rotate("Z", theta), 0, -l, 0), m)
    >>> pendulum = lagrange_equations(System([bob], coordinates=[theta], gravity=Vector(ground, 0, -g, 0)))
    >>> simulate_many(pendulum, {m: 1, g: 9.81, l: [0.5, 1.0, 2.0]}, {theta: 0.1}, t=(0, 2))
    Runs(3 cases, 1001 instants)
    """
    workforce = checked_workforce(PLACE, executor, core_count() if threads is None else threads, path)
    if sensitivities and not keep_states:
        raise ArgumentError(
            f"{PREFIX}keep_states=False, and sensitivities are those of states; leave one of them out"
        )
    all_cases = cases_of(parameters, initial, cases)
    task = task_of(
        eqs,
        all_cases.parameters,
        t,
        inputs=inputs,
        method=method,
        rtol=rtol,
        atol=atol,
        outputs=outputs,
        events=events,
        constraints=constraints,
        guess=guess,
        max_step=max_step,
        sensitivities=sensitivities,
        keeps_states=keep_states,
        where=PLACE,
    )
    check_cases(task, all_cases)
    check_one_workforce(executor, device, PLACE)
    task = on_device(task, device, PLACE)
    warn_of_odd_parameters(task, all_cases.parameters, PLACE)
    file = None if path is None else ResultsFile(Path(path), problem_digest(task, all_cases))
    results = _results_so_far(file, empty_results(task, all_cases.count))
    run = _Batch(task, all_cases, results, file)
    with Interruption() as interruption:
        reason = run.run_missing(*workforce, interruption, progress=progress)
    runs = Runs(task, all_cases, results)
    _warn(runs, reason, run.fault, has_path=path is not None)
    return runs


def _warn(runs: Runs, reason: str, fault: str, *, has_path: bool) -> None:
    """Warn of failures, of gaps, of a file that was not written, and of what the cases have found."""
    ended = runs.ends.notices(
        reason.removeprefix(PREFIX),
        values="their values are NaN from where they ended",
        gaps="and their values are NaN",
        has_path=has_path,
    )
    texts = [PREFIX + notice.removeprefix(PREFIX) for notice in (*ended, fault) if notice]
    for text in (*texts, *notices_of_batch(runs.findings, PLACE)):
        notify(text)


def _results_so_far(file: ResultsFile | None, empty: Results) -> Results:
    """Return the results of the file, or empty ones; check first that the file can be written."""
    if file is None:
        return empty
    file.check_writable()
    return file.read() or empty


@dataclass(eq=False)
class _Batch:
    """A batch in progress."""

    task: Task
    cases: Cases
    results: Results
    file: ResultsFile | None
    fault: str = ""
    """The reason why the last save failed, if it did."""
    _saved: float = field(default_factory=monotonic)
    _pause: float = field(default_factory=lambda: SAVE_EVERY)
    _has_news: bool = False

    def run_missing(
        self, executor: Executor | None, threads: int, interruption: Interruption, *, progress: bool | None
    ) -> str:
        """Run the missing cases; return why some of them were not run."""
        missing, count = self.results.missing, len(self.results.status)
        finished = count - len(missing)
        with progress_bar("simulate", count, is_shown=progress) as show:

            def keep_going(done: float) -> bool:
                show(finished + done)
                return not interruption.is_asked_for

            if executor is None:
                span = inf if self.file is None else SAVE_EVERY
                parts = run_in_threads(self.task, self.cases, missing, threads, keep_going, span)
            else:
                parts = run_by_executor(self.task, self.cases, missing, executor, keep_going)
            reason = self._take(parts)
            show(count - len(self.results.missing))
        return "interrupted" if interruption.is_asked_for else reason

    def _take(self, parts: Iterator[Part]) -> str:
        """Store all parts; if the executor fails, keep those that are there."""
        try:
            for chosen, part in parts:
                self.results.put(chosen, part)
                self._has_news = True
                self._save_now_and_then()
        except SimulationError as error:
            if len(self.results.missing) == len(self.results.status):
                raise
            return str(error)
        finally:
            if self.file is not None and self._has_news:
                self._save(self.file)
        return ""

    def _save_now_and_then(self) -> None:
        if self.file is not None and monotonic() - self._saved > self._pause:
            self._save(self.file)

    def _save(self, file: ResultsFile) -> None:
        """Write the file. If that fails, continue: the results are still in memory."""
        begin = monotonic()
        try:
            file.write(self.results)
            self.fault, self._has_news = "", False
        except ResultsError as error:
            self.fault = str(error)
        self._saved = monotonic()
        self._pause = max(SAVE_EVERY, SAVE_PAUSE * (self._saved - begin))
