"""Integration by IDA, with the interface that all methods share."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import partial

import numpy as np
from numpy.typing import NDArray

from symbody.errors import SimulationError
from symbody.simulation.given.event import Event
from symbody.simulation.given.options import Options
from symbody.simulation.integrate.energy_balance import imbalance_of
from symbody.simulation.integrate.ida import IdaRun, integrate_ida
from symbody.simulation.integrate.ida_problem import GoesOnAt
from symbody.simulation.integrate.outcome import Failure, FailureKind, Outcome, Statistics, with_deficiencies
from symbody.simulation.integrate.task import Columns, Integrate, KeepGoing, Task
from symbody.simulation.model.model import Model
from symbody.symbolic import Expr
from symbody.symbolic.numeric.deficiency import noting

__all__ = ["prepare", "run_ida"]


def prepare(task: Task, *, form: str) -> Integrate:
    """Return the function that integrates the motions of a task, one after another.

    Args:
        task: the task.
        form: the form of the equations, one of `symbody.simulation.integrate.dae.FORMS`.
    """
    return partial(_integrate, task, form)


def _integrate(
    task: Task,
    form: str,
    parameters: Columns,
    states: NDArray[np.float64],
    _threads: int,
    keep_going: KeepGoing,
) -> Iterator[Outcome | None]:
    """Integrate motions one after another, and yield their outcomes; None for those that were not started.

    Args:
        task: the task.
        form: the form of the equations.
        parameters: values by name, one for each of the k motions.
        states: the initial states, shape (k, model.width).
        _threads: not used: IDA runs one motion at a time.
        keep_going: see `KeepGoing`; False ends all of them.
    """
    first, span, size = float(task.instants[0]), float(np.ptp(task.instants)), len(task.model.state)
    for case, state in enumerate(states):

        def goes_on(t: float, done: int = case) -> bool:
            return keep_going(done + (t - first) / span)

        if not keep_going(case):
            yield None
            continue
        values = {name: float(column[case]) for name, column in parameters.items()}
        with noting() as found:
            outcome = run_ida(
                task.model, state[:size], values, task.instants, task.options, task.events, goes_on, form=form
            )
        yield with_deficiencies(outcome, found)


def run_ida(
    model: Model,
    state: NDArray[np.float64],
    parameters: Mapping[Expr, float],
    instants: NDArray[np.float64],
    options: Options,
    events: Sequence[Event] = (),
    keep_going: GoesOnAt | None = None,
    *,
    form: str = "stabilized",
) -> Outcome:
    """Integrate one motion by IDA, and return the outcome in the form of the native integrator.

    Args:
        model: the model.
        state: coordinates and speeds at the first instant, shape (n,).
        parameters: the values of the parameters.
        instants: the instants of the results, shape (N,), in s.
        options: the method by name and its tolerances.
        events: the events to watch.
        keep_going: called from time to time with the time reached; False ends the motion.
        form: the form of the equations, one of `symbody.simulation.integrate.dae.FORMS`.
    """
    failure = None
    try:
        run = integrate_ida(
            model.equations,
            parameters,
            state,
            instants,
            index=form,
            rtol=options.rtol,
            atol=options.atol,
            inputs=dict(model.inputs),
            events=events,
            keep_going=keep_going,
            max_step=options.max_step,
        )
    except SimulationError as error:
        if not isinstance(error.motion, IdaRun):
            return _failed_start(state, float(instants[0]), str(error))
        run = error.motion
        failure = Failure(FailureKind.EXPLAINED, float(run.t[-1]), str(error))
    if failure is None and not run.completed:
        failure = Failure(FailureKind.INTERRUPTED, float(run.t[-1]), run.message)
    reached = int(np.isin(run.t, instants).sum())
    values = np.array([parameters[name] for name in (*model.parameters, *model.damping)])
    # IDA does not report its steps; each takes about two evaluations.
    steps = run.statistics.evaluations // 2
    imbalance = imbalance_of(
        model,
        values,
        instants[:reached],
        run.states[:reached],
        options,
        steps,
        are_speeds_tested=form != "3",
    )
    return Outcome(
        run.states[:reached],
        [(event.event, event.t, list(event.state)) for event in run.events],
        (float(run.t[-1]), list(run.states[-1])),
        failure,
        Statistics(0, 0, run.statistics.evaluations, run.statistics.jacobians, is_stiff=False),
        imbalance=imbalance,
        trail=run.trail,
    )


def _failed_start(state: NDArray[np.float64], t: float, message: str) -> Outcome:
    failure = Failure(FailureKind.EXPLAINED, t, message)
    return Outcome(state[np.newaxis], [], (t, list(state)), failure, Statistics(0, 0, 0, 0, is_stiff=False))
