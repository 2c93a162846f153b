"""Motions as integrated, by the method of their task."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from symbody.simulation.model.model import DAMPING
from symbody.symbolic import Expr

from .contradictory_constraints import with_contradictions
from .outcome import Outcome
from .task import Columns, KeepGoing, Task
from .with_sensitivities import with_sensitivities

__all__ = ["Integrated", "run_motions"]

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Integrated:
    """A motion as integrated.

    Attributes:
        task: the task.
        parameters: the values of the parameters, including those of Baumgarte's stabilisation.
        outcome: the outcome of the integration.
    """

    task: Task
    parameters: Mapping[Expr, float]
    outcome: Outcome


def run_motions(
    task: Task, parameters: Columns, states: Array, threads: int, keep_going: KeepGoing
) -> Iterator[Integrated | None]:
    """Integrate motions and yield them in order; None for those that were not started.

    Args:
        task: the task.
        parameters: values by name, one for each of the k motions.
        states: the initial states, shape (k, model.width).
        threads: how many motions to integrate at a time.
        keep_going: called from time to time with the number of finished motions; False ends all of them.
    """
    columns = _with_damping(task, parameters, states)
    sized = _with_sizes(task, columns, len(states))
    outcomes = task.integrate(sized, states, threads, keep_going) if len(states) else ()
    for case, outcome in enumerate(outcomes):
        if outcome is None:
            yield None
            continue
        values = _values_of(columns, case)
        own = outcome if task.variation is None else with_sensitivities(outcome, task, task.variation, values)
        yield Integrated(task, values, with_contradictions(own, task.model, values, task.instants))


def _with_damping(task: Task, parameters: Columns, states: Array) -> Columns:
    """Return the parameters, with those of Baumgarte's stabilisation if it is used."""
    if not task.model.is_stabilized:
        return parameters
    chosen = [task.damping_of(_values_of(parameters, case), state) for case, state in enumerate(states)]
    return {**parameters, **{name: np.array([damping[name] for damping in chosen]) for name in DAMPING}}


def _with_sizes(task: Task, parameters: Columns, cases: int) -> Columns:
    """Return the parameters, with the sizes of those by which the state is differentiated."""
    variation = task.variation
    if variation is None:
        return parameters
    rows = np.array([variation.size_values(_values_of(parameters, case)) for case in range(cases)])
    return {**parameters, **dict(zip(variation.sizes, rows.T, strict=True))}


def _values_of(parameters: Columns, case: int) -> dict[Expr, float]:
    return {name: float(values[case]) for name, values in parameters.items()}
