"""The native integrator: it calls compiled equations, with no Python in its loop."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace
from functools import partial

import numpy as np
from numpy.typing import NDArray

from symbody.codegen import PreparedCode
from symbody.codegen.llvm.jit import lanes
from symbody.simulation.given.event import Event
from symbody.simulation.given.options import Options
from symbody.simulation.model.model import Model
from symbody.simulation.model.variation import Variation
from symbody.symbolic.numeric.deficiency import Deficiency, deficiencies_of, noting

from .occurrences import Occurrences
from .outcome import Failure, FailureKind, Outcome, Statistics, with_deficiencies
from .outcomes import Outcomes
from .problem import Problem
from .task import Columns, Integrate, KeepGoing, Task

__all__ = ["prepare", "problem_of", "run", "run_many"]


WORTH_LANES = 256
"""The number of motions from which lock-step pays: with fewer, its code takes longer to compile than it saves."""

LEAST_LANES = 4
"""The number of lanes from which lock-step pays: with two, the exchange of numbers takes what the vectors save."""


def prepare(task: Task, *, needs_jacobian: bool = False) -> Integrate:
    """Return the function that integrates the motions of a task; derive and compile what it calls.

    Args:
        task: the task.
        needs_jacobian: whether the method is implicit.
    """
    problem = problem_of(
        task.model,
        is_projected=task.is_projected,
        needs_jacobian=needs_jacobian,
        events=task.events,
        trail=task.trail,
        variation=task.variation,
    )
    problem.native  # noqa: B018 - compiled now
    return partial(_integrate, problem, task.instants, task.options)


def problem_of(
    model: Model,
    *,
    is_projected: bool,
    needs_jacobian: bool = False,
    events: Sequence[Event] = (),
    trail: int = 0,
    variation: Variation | None = None,
) -> Problem:
    """Return the compiled functions of a model. They are derived here, and compiled when their addresses are read.

    Args:
        model: the model.
        is_projected: whether states are projected onto the constraints after each step.
        needs_jacobian: whether the method is implicit.
        events: the events to watch.
        trail: the most states at the ends of steps that are kept.
        variation: the equations of the sensitivities, if these are integrated.
    """
    code = model.code_along_motion([event.expression for event in events]) if events else None
    corrects = is_projected and bool(model.constraints)
    plain = Problem(
        width=model.width,
        controlled=len(model.state),
        rates=model.rates_code,
        jacobian=model.jacobian_code if needs_jacobian and variation is None else None,
        corrections=model.correction_codes if corrects else None,
        energies=model.energies_code,
        events=None if code is None else (code, tuple(events)),
        trail=trail,
    )
    if variation is None:
        return plain
    return _with_sensitivities(plain, variation, needs_jacobian=needs_jacobian, corrects=corrects)


def _with_sensitivities(
    plain: Problem, variation: Variation, *, needs_jacobian: bool, corrects: bool
) -> Problem:
    """Return the problem whose vector is (x, S, work). S is in the error estimate, as the state x is."""
    return replace(
        plain,
        width=variation.width,
        controlled=plain.controlled + variation.count,
        rates=variation.rates_code,
        jacobian=variation.jacobian_code if needs_jacobian else None,
        corrections=variation.state_correction_codes if corrects else None,
        of_sensitivities=(variation.correction_code, plain.controlled) if corrects else None,
        energies=variation.energies_code,
        events=_watched(plain, variation),
    )


def _watched(plain: Problem, variation: Variation) -> tuple[PreparedCode, tuple[Event, ...]] | None:
    """Return the events, and then those at which the rates may jump."""
    if not variation.switching:
        return None if plain.events is None else (variation.widened(plain.events[0]), plain.events[1])
    hidden = tuple(Event(each) for each in variation.switching)
    if plain.events is None:
        return variation.code(variation.switching), hidden
    code = variation.widened(plain.events[0])
    both = replace(code, expressions=(*code.expressions, *variation.switching), shortcut=None)
    return both, (*plain.events[1], *hidden)


def _integrate(
    problem: Problem,
    instants: NDArray[np.float64],
    options: Options,
    parameters: Columns,
    states: NDArray[np.float64],
    threads: int,
    keep_going: KeepGoing,
) -> Iterable[Outcome | None]:
    """Integrate one motion, or many in threads outside the interpreter.

    Args:
        problem: the compiled functions.
        instants: the instants of the results, shape (N,), in s.
        options: the method by name and its tolerances.
        parameters: values by name, one for each of the k motions.
        states: the initial states, shape (k, width).
        threads: how many motions to integrate at a time.
        keep_going: see `KeepGoing`; False ends all of them.
    """
    rows = np.empty((len(states), len(problem.parameters)))
    for place, name in enumerate(problem.parameters):
        rows[:, place] = parameters[name]
    if len(states) != 1:
        return run_many(problem, states, rows, instants, options, threads, keep_going)
    first, span = float(instants[0]), float(instants[-1] - instants[0])
    with noting() as found:
        constants = problem.constants(rows[0])
        outcome = run(
            problem, states[0], constants, instants, options, lambda t: keep_going((t - first) / span)
        )
    return [with_deficiencies(outcome, found)]


def _limits(problem: Problem, options: Options) -> tuple[float, float, float, int]:
    return options.rtol, options.atol, options.max_step, problem.controlled


def run(
    problem: Problem,
    state: NDArray[np.float64],
    constants: NDArray[np.float64],
    instants: NDArray[np.float64],
    options: Options,
    keep_going: Callable[[float], bool] | None = None,
) -> Outcome:
    """Integrate one motion through all instants.

    Args:
        problem: the compiled functions.
        state: the vector at the first instant, shape (width,).
        constants: what the functions need of the parameters; see `Problem.constants`.
        instants: the instants of the results, shape (N,), in s.
        options: the method by name and its tolerances.
        keep_going: called from time to time with the time reached, in s; False ends the motion.
    """
    states = np.empty((len(instants), problem.width))
    given = problem.native.integrate(
        options.method,
        np.ascontiguousarray(state, float),
        constants,
        np.ascontiguousarray(instants, float),
        _limits(problem, options),
        states,
        problem.trail,
        keep_going,
    )
    return _outcome(given, states)


def run_many(
    problem: Problem,
    states: NDArray[np.float64],
    parameters: NDArray[np.float64],
    instants: NDArray[np.float64],
    options: Options,
    threads: int = 1,
    keep_going: KeepGoing | None = None,
) -> Outcomes:
    """Integrate many motions in threads outside the interpreter.

    Args:
        problem: the compiled functions.
        states: the vectors at the first instant of the k motions, shape (k, width).
        parameters: the values of the parameters, one row for each motion.
        instants: the instants of the results, shape (N,), in s.
        options: the method by name and its tolerances.
        threads: how many motions to integrate at a time.
        keep_going: see `KeepGoing`; False ends all of them.

    Returns:
        An outcome for each motion; None for those that were not started.
    """
    results = np.full((len(states), len(instants), problem.width), np.nan)
    constants, lacking = _prepared(problem, parameters)
    is_worth_it = len(states) >= WORTH_LANES and problem.jacobian is None and lanes() >= LEAST_LANES
    width = lanes() if is_worth_it else 1
    counts, ends, happened, found = (problem.native if width == 1 else problem.in_lanes).integrate_many(
        options.method,
        np.ascontiguousarray(states, float),
        constants,
        np.ascontiguousarray(instants, float),
        _limits(problem, options),
        results,
        problem.trail,
        (threads, width),
        keep_going,
    )
    remarkable = {
        place: _outcome(given, results[place], deficiencies_of(noted) | lacking.get(place, set()))
        for place, given, noted in found
    }
    numbers = np.frombuffer(counts, dtype=np.int64).reshape(-1, 6)
    outcomes = Outcomes(
        results,
        numbers[:, :5],
        numbers[:, 5],
        np.frombuffer(ends),
        _occurrences(happened, problem.width),
        remarkable,
    )
    for place in lacking.keys() - remarkable.keys():
        plain = outcomes[place]
        if plain is not None:
            remarkable[place] = with_deficiencies(plain, lacking[place])
    return outcomes


def _occurrences(columns: tuple[bytes, bytes, bytes, bytes], size: int) -> Occurrences:
    """Return the events of many motions, whose columns are bytes."""
    case, event = (np.frombuffer(column, dtype=np.int64) for column in columns[:2])
    t, state = (np.frombuffer(column) for column in columns[2:])
    return Occurrences(case, event, t, state.reshape(-1, size), np.empty((len(t), size, 0)))


def _prepared(
    problem: Problem, parameters: NDArray[np.float64]
) -> tuple[NDArray[np.float64], dict[int, set[Deficiency]]]:
    """Return the constants of all motions, in rows, and the deficient linear systems that depend on parameters alone.

    These are given by the number of the motion.
    """
    if (parameters == parameters[:1]).all():  # sorting takes as long as a short motion
        different, places = parameters[:1], np.zeros(len(parameters), dtype=np.intp)
    else:
        different, places = np.unique(parameters, axis=0, return_inverse=True)
    with noting() as found:
        constants = problem.constants_of_many(different)
    lacking: dict[int, set[Deficiency]] = {}
    if found:
        for place, row in enumerate(parameters):
            with noting() as own:
                problem.constants(row)
            if own:
                lacking[place] = own
    return constants[places], lacking


_Given = tuple[
    int,
    list[tuple[int, float, list[float]]],
    tuple[float, list[float]],
    tuple[str, float, str] | None,
    tuple[int, int, int, int, bool],
    tuple[float, float] | None,
    bytes,
    float | None,
]


def _outcome(given: _Given, states: NDArray[np.float64], deficiencies: Iterable[Deficiency] = ()) -> Outcome:
    reached, occurrences, end, failed, statistics, imbalance, trail, uncertain = given
    failure = None
    if failed is not None:
        kind, t, message = failed
        failure = Failure(FailureKind(kind), t, message)
    return Outcome(
        states[:reached],
        occurrences,
        end,
        failure,
        Statistics(*statistics),
        frozenset(deficiencies),
        imbalance,
        np.frombuffer(trail).reshape(-1, 1 + states.shape[1]),
        uncertain,
    )
