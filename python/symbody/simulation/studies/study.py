"""Studies: very many motions, of which only numbers and statistics are kept."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from concurrent.futures import Executor
from math import inf
from pathlib import Path
from typing import Any

from numpy.typing import ArrayLike

from symbody.dynamics import Equations
from symbody.errors import notify
from symbody.simulation.batch.cases import Values, cases_of
from symbody.simulation.batch.workers import check_one_workforce, checked_workforce, core_count
from symbody.simulation.given.event import Event
from symbody.symbolic import Expr, ExprLike
from symbody.symbolic.given.arguments import with_known_names

from .accumulation import Accumulation
from .asked import asked_of, check_names
from .measures.measure import Measure
from .plan import PLACE
from .plan_of import plan_of
from .sample.lazy_sample import LazySample
from .statistics.statistic import Statistic
from .study_file import opened_file
from .study_results import Study
from .study_run import StudyRun, chunk_size

__all__ = ["study"]


@with_known_names
def study(
    eqs: Equations,
    parameters: Values | None = None,
    initial: Values | None = None,
    t: tuple[float, float] | ArrayLike = (0.0, 10.0),
    *,
    cases: Values | LazySample | None = None,
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
    device: str | None = None,
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
        cases: values of parameters and initial values together: a `sample`, a `LazySample`, or a `grid`.
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
        device: ``"cuda"`` for a graphics processor, as in `simulate_many`.
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
    check_one_workforce(executor, device, PLACE)
    all_cases = cases_of(parameters, initial, cases, PLACE)
    asked = asked_of(measures, outputs, statistics, events, histories=histories, path=path)
    options: dict[str, Any] = {"inputs": inputs, "method": method, "rtol": rtol, "atol": atol}
    options |= {"constraints": constraints, "guess": guess, "max_step": max_step}
    plan = plan_of(eqs, all_cases, t, asked, device, options)
    check_names(plan, all_cases, units, has_file=path is not None)
    size = chunk_size(plan, all_cases.count, chunk)
    file = None if path is None else opened_file(Path(path), plan, all_cases, size, units or {})
    found = Accumulation.begun(plan, all_cases.count, size, file)
    reason = StudyRun(plan, all_cases, found).run_missing(*workforce, progress=progress)
    result = Study(plan, all_cases, found, dict(units or {}))
    ended = result.ends.notices(
        reason.removeprefix(f"{PLACE}: "),
        values="their measures are NaN, and statistics over time count them up to where they ended",
        gaps="their measures are NaN, and statistics over time leave them out",
        has_path=path is not None,
    )
    for text in (*(f"{PLACE}: {notice}" for notice in ended), *result.notices):
        notify(text)
    return result
