"""The plan of a study: what is integrated, and what is computed of each motion."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import accumulate

import numpy as np
from numpy.typing import ArrayLike, NDArray

from symbody.errors import ArgumentError, SimulationError
from symbody.simulation.given.event import Event
from symbody.simulation.given.options import instants_of
from symbody.simulation.integrate.task import Task
from symbody.symbolic import Expr
from symbody.symbolic.given.arguments import described

from .measures.measure import Measure
from .statistics.statistic import Statistic

__all__ = ["Plan", "checked_measures", "checked_statistics", "study_instants"]

Array = NDArray[np.float64]

PLACE = "study"
"""The function that messages name."""


@dataclass(frozen=True, eq=False)
class Plan:
    """What all chunks of a study share.

    Attributes:
        task: the model, the method and the events: those of the user, then those of the measures.
        measures: the measures, by name.
        integrals: the state that is the integral of a measure, by name, for those that have one.
        outputs: the expressions over time, by name.
        statistics: the statistics of the outputs over all cases.
        keeps_histories: whether the outputs of all cases are kept.
        own_events: the number of events of the user.
    """

    task: Task
    measures: Mapping[str, Measure]
    integrals: Mapping[str, Expr]
    outputs: Mapping[str, Expr]
    statistics: tuple[Statistic, ...]
    keeps_histories: bool
    own_events: int

    @property
    def columns(self) -> tuple[str, ...]:
        """The names of the numbers that measures give."""
        return tuple(name + part for name, measure in self.measures.items() for part in measure.parts)

    @property
    def event_ranges(self) -> dict[str, range]:
        """The events of each measure among those of the task."""
        sizes = [len(measure.events) for measure in self.measures.values()]
        ends = list(accumulate(sizes, initial=self.own_events))
        return {name: range(ends[k], ends[k + 1]) for k, name in enumerate(self.measures)}

    @property
    def expressions(self) -> list[Expr]:
        """What is evaluated along the motions: outputs, then the expressions of measures."""
        return [*self.outputs.values(), *(measure.expression for measure in self.measures.values())]

    @property
    def with_names(self) -> Task:
        """The task with outputs and measures as named outputs, for checks and digests."""
        named = {f"measure {name}": measure.expression for name, measure in self.measures.items()}
        return replace(self.task, outputs={**self.outputs, **named})


def checked_measures(measures: object) -> dict[str, Measure]:
    """Return the measures by name.

    Raises:
        ArgumentError: they are something else.
    """
    given: object = {} if measures is None else measures
    is_named = isinstance(given, Mapping) and all(isinstance(name, str) for name in given)
    if not isinstance(given, Mapping) or not is_named:
        raise ArgumentError(
            f"{PLACE}, measures: {described(measures)}; expected a dictionary of names and measures, such as "
            "{'peak': measures.maximum(x)}"
        )
    for name, measure in given.items():
        if not isinstance(measure, Measure):
            raise ArgumentError(
                f"{PLACE}, measures: {name}: {described(measure)}; expected a measure, such as "
                "measures.maximum(x) or measures.final(x); expressions over time are outputs"
            )
    columns = [name + part for name, measure in given.items() for part in measure.parts]
    twice = next((name for name in columns if columns.count(name) > 1), None)
    if twice is not None:
        raise ArgumentError(f"{PLACE}, measures: two of them give {twice!r}; rename one of them")
    return dict(given)


def checked_statistics(statistics: object) -> tuple[Statistic, ...]:
    """Return the statistics.

    Raises:
        ArgumentError: they are something else.
    """
    listed = [statistics] if isinstance(statistics, Statistic) else statistics
    if not isinstance(listed, list | tuple) or not all(isinstance(each, Statistic) for each in listed):
        raise ArgumentError(
            f"{PLACE}: statistics={described(statistics)}; expected a list of statistics, such as "
            "[statistics.moments(), statistics.quantiles(0.05, 0.95)]"
        )
    return tuple(listed)


def study_instants(t: ArrayLike, measures: Mapping[str, Measure], *, has_outputs: bool) -> Array:
    """Return the instants that are needed: those of outputs, those of measures, the first and the last one.

    Raises:
        SimulationError: the instants are none, or a measure needs one that is beyond them.
    """
    whole = instants_of(t, PLACE)
    span = whole[[0, -1]] if not has_outputs and np.size(np.asarray(t)) == 2 else whole
    wanted = {name: instant for name, measure in measures.items() for instant in measure.instants}
    for name, instant in wanted.items():
        if not whole[0] <= instant <= whole[-1]:
            raise SimulationError(
                f"{PLACE}, measures: {name!r} is the value at t = {instant:g} s; expected an instant from "
                f"{whole[0]:g} to {whole[-1]:g} s"
            )
    return np.unique(np.concatenate([span, [*wanted.values()]]))


def all_events(own: Sequence[Event], measures: Mapping[str, Measure]) -> list[Event]:
    """Return the events of the user, then those of the measures."""
    return [
        *own,
        *(
            replace(event, name=f"of the measure {name!r}")
            for name, measure in measures.items()
            for event in measure.events
        ),
    ]
