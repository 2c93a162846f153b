"""The sensitivities in an outcome: they are integrated in one vector with the state, and are taken out of it here."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from symbody.simulation.model.variation import Variation
from symbody.symbolic import Expr

from .outcome import Outcome, Sensitivities
from .rate_jump import rate_jump
from .task import Task

__all__ = ["beside_sensitivities", "with_sensitivities"]

Array = NDArray[np.float64]


def beside_sensitivities(
    state: Array, slopes: Array, variation: Variation, parameters: Mapping[Expr, float]
) -> Array:
    """Return the vector that is integrated: the state, the sensitivities times the sizes of parameters, the work.

    Args:
        state: the state, and the work where the model has it.
        slopes: the derivatives of the state by the parameters, shape (n, k).
        variation: the equations of the sensitivities.
        parameters: the values of the parameters.
    """
    n, sized = len(slopes), slopes * variation.size_values(parameters)
    return np.concatenate([state[:n], sized.ravel(), state[n:]])


def with_sensitivities(
    outcome: Outcome, task: Task, variation: Variation, parameters: Mapping[Expr, float]
) -> Outcome:
    """Return the outcome of the state alone, with the sensitivities beside it; they are NaN where they are unknown."""
    sizes = variation.size_values(parameters)
    n, count, k = len(variation.model.state), variation.count, len(variation.by)

    def slopes(vectors: Sequence[Sequence[float]] | Array) -> Array:
        rows = np.reshape(np.asarray(vectors, dtype=np.float64), (-1, variation.width))
        found: Array = rows[:, n : n + count].reshape(-1, n, k) / sizes
        return found

    def rest(vector: list[float]) -> list[float]:
        return [*vector[:n], *vector[n + count :]]

    end, events, own = outcome.end, outcome.occurrences, len(task.events)
    kept = [(event, t, state) for event, t, state in events if event < own]
    along, last, at_events = (
        slopes(outcome.states),
        slopes([end[1]])[0],
        slopes([state for _, _, state in kept]),
    )
    switches = [(event - own, t, rest(state)) for event, t, state in events if event >= own]
    jump = _first_jump(switches, variation, parameters)
    if jump is not None:
        along[task.instants[: len(along)] > jump[0]] = np.nan
        at_events[[t > jump[0] for _, t, _ in kept]] = np.nan
        last = np.full_like(last, np.nan) if end[0] > jump[0] else last
    of_time = slice(1 + n, 1 + n + count)
    return replace(
        outcome,
        states=np.delete(outcome.states, slice(n, n + count), axis=1),
        end=(end[0], rest(end[1])),
        occurrences=[(event, t, rest(state)) for event, t, state in kept],
        trail=np.delete(outcome.trail, of_time, axis=1) if len(outcome.trail) else outcome.trail,
        sensitivities=Sensitivities(along, last, at_events, jump),
    )


def _first_jump(
    switches: Sequence[tuple[int, float, list[float]]], variation: Variation, parameters: Mapping[Expr, float]
) -> tuple[float, str] | None:
    """Return the first instant at which the rates jump, and the function that is zero there."""
    code, n = variation.model.rates_code, len(variation.model.state)
    values = np.array([parameters[name] for name in code.parameters])
    for place, t, vector in switches:
        if rate_jump(code, values, t, np.array(vector), n):
            return t, str(variation.switching[place])
    return None
