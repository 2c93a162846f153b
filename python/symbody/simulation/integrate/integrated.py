"""Motions as integrated, by the method of their task."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from symbody.simulation.model.model import DAMPING
from symbody.symbolic import Expr

from .contradictory_constraints import with_contradictions
from .occurrences import Occurrences
from .outcome import Outcome
from .outcomes import Outcomes
from .task import Columns, KeepGoing, Task
from .with_sensitivities import with_sensitivities

__all__ = ["Integrated", "Motions", "run_motions"]

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


@dataclass(frozen=True, eq=False)
class Motions:
    """The motions of a task, in order; each is made when it is asked for.

    Attributes:
        task: the task.
        columns: the values of the parameters by name, one for each of the k motions.
        starts: the initial states, shape (k, width).
        outcomes: their outcomes; methods that are not native yield them one by one.
    """

    task: Task
    columns: Columns
    starts: Array
    outcomes: Iterable[Outcome | None]

    def __iter__(self) -> Iterator[Integrated | None]:
        """Yield the motions; None for those that were not started."""
        for case, outcome in enumerate(self.outcomes):
            yield self._motion(case, outcome)

    def among(self, places: Iterable[int]) -> Iterator[tuple[int, Integrated | None]]:
        """Yield the motions at some places, with these, in order."""
        wanted, whole = sorted(set(places)), self._whole
        if whole is not None:
            yield from ((case, self._motion(case, whole[case])) for case in wanted)
            return
        for case, motion in enumerate(self):
            if case in wanted:
                yield case, motion

    @property
    def plain(self) -> NDArray[np.bool_]:
        """Which motions are their outcome, with nothing to tell of it but costs and events, shape (k,)."""
        if self._whole is None or self.task.variation is not None:
            return np.zeros(len(self.starts), dtype=bool)
        return self._whole.plain

    @property
    def counts(self) -> NDArray[np.int64]:
        """The costs of plain motions, and of others, as in `Outcomes`, shape (k, 5)."""
        return self._found.counts

    @property
    def states(self) -> Array:
        """The states of plain motions, and of others, as in `Outcomes`, shape (k, N, width)."""
        return self._found.states

    @property
    def is_whole(self) -> NDArray[np.bool_]:
        """Which motions reached the last instant, shape (k,); other plain ones ended at a terminal event."""
        return self._found.is_whole

    @property
    def reached(self) -> NDArray[np.int64]:
        """The number of instants that each motion reached, shape (k,)."""
        return self._found.reached

    @property
    def end_t(self) -> Array:
        """The instant at which each motion ended, in s, shape (k,)."""
        return self._found.end_t

    @property
    def ends(self) -> Array:
        """The states where plain motions ended, shape (k, width)."""
        return self._found.ends

    @property
    def occurrences(self) -> Occurrences:
        """The events of plain motions."""
        return self._found.occurrences

    @property
    def _whole(self) -> Outcomes | None:
        return self.outcomes if isinstance(self.outcomes, Outcomes) else None

    @property
    def _found(self) -> Outcomes:
        assert self._whole is not None, "motions by a native method"
        return self._whole

    def values(self, names: Sequence[Expr]) -> Array:
        """Return the values of parameters, shape (k, names)."""
        columns = [np.broadcast_to(self.columns[name], len(self.starts)) for name in names]
        return np.stack(columns, axis=1) if columns else np.empty((len(self.starts), 0))

    def _motion(self, case: int, outcome: Outcome | None) -> Integrated | None:
        if outcome is None:
            return None
        task, values = self.task, _values_of(self.columns, case)
        own = outcome if task.variation is None else with_sensitivities(outcome, task, task.variation, values)
        return Integrated(task, values, with_contradictions(own, task.model, values, task.instants))


def run_motions(
    task: Task, parameters: Columns, states: Array, threads: int, keep_going: KeepGoing
) -> Motions:
    """Integrate motions.

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
    return Motions(task, columns, states, outcomes)


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
