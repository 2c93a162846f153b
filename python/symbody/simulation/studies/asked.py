"""What a user asks of a study: measures, outputs over time, statistics and events, checked."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from symbody.errors import ArgumentError
from symbody.simulation.batch.cases import Cases
from symbody.simulation.given.event import Event
from symbody.simulation.integrate.outputs_and_events import given_events, given_outputs
from symbody.symbolic import Expr, ExprLike
from symbody.symbolic.given.arguments import described
from symbody.symbolic.given.similar_name import did_you_mean

from .measures.measure import Measure
from .plan import PLACE, Plan, checked_measures, checked_statistics
from .statistics.extremes import extremes
from .statistics.moments import moments
from .statistics.statistic import Statistic
from .study_arrays import over_time_names

__all__ = ["Asked", "asked_of", "check_names"]


@dataclass(frozen=True, eq=False)
class Asked:
    """What is computed of the motions of a study.

    Attributes:
        measures: the measures, by name.
        outputs: the expressions over time, by name.
        statistics: the statistics of the outputs.
        events: the events of the user.
        histories: whether the outputs of all cases are kept.
    """

    measures: Mapping[str, Measure]
    outputs: Mapping[str, Expr]
    statistics: tuple[Statistic, ...]
    events: tuple[Event, ...]
    histories: bool


def asked_of(
    measures: object,
    outputs: Mapping[str, ExprLike] | None,
    statistics: object,
    events: Sequence[Event] | None,
    *,
    histories: bool,
    path: object,
) -> Asked:
    """Return what a user asks for.

    Args:
        measures: the measures, by name.
        outputs: the expressions over time, by name.
        statistics: the statistics of the outputs; by default moments and extremes.
        events: the events that end motions.
        histories: whether the outputs of all cases are kept.
        path: where the file is, if there is one.

    Raises:
        ArgumentError: an argument has the wrong kind, nothing is computed, or histories have no place.
    """
    named, given = checked_measures(measures), given_outputs(outputs, PLACE)
    own = tuple(given_events(events, PLACE))
    kinds = checked_statistics((moments(), extremes()) if statistics is None else statistics)
    _check_kept(named, given, histories=histories, path=path)
    if statistics is not None and kinds and not given:
        raise ArgumentError(
            f"{PLACE}: statistics={described(statistics)}, but there are no outputs over time; "
            "give outputs={'x': x}. Study.summary has the statistics of measures"
        )
    return Asked(named, given, kinds if given else (), own, histories)


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


def check_names(plan: Plan, cases: Cases, units: object, *, has_file: bool) -> None:
    """Check that measures and outputs have names of their own, and parameters if there is a file."""
    if units is not None and not (
        isinstance(units, Mapping) and all(isinstance(each, str) for pair in units.items() for each in pair)
    ):
        raise ArgumentError(
            f"{PLACE}, units: {described(units)}; expected names and units, such as {{'peak': 'm/s'}}"
        )
    if isinstance(units, Mapping):
        _check_units(plan, cases, units)
    given = [*map(str, cases.parameters), *(f"initial_{name}" for name in cases.initial)]
    taken = ["case", "t", "status", "t_reached", "message", "progress", *over_time_names(plan)]
    for name in given if has_file else ():
        if name in taken:
            raise ArgumentError(
                f"{PLACE}: the file needs the name {name!r} for an array of its own, but a parameter has it; rename "
                "the parameter, or leave out path"
            )
        taken.append(name)
    taken += given
    for name in (*plan.columns, *plan.outputs):
        if name in taken or "/" in name or not name:
            raise ArgumentError(
                f"{PLACE}: the name {name!r} of a measure or an output is taken, or contains '/'; rename it"
            )
        taken.append(name)


def _check_units(plan: Plan, cases: Cases, units: Mapping[str, str]) -> None:
    """Check that each unit belongs to something: one with a wrong name would be missing in files and plots."""
    own = [*plan.columns, *plan.outputs, *map(str, cases.parameters)]
    own += [text for name in cases.initial for text in (str(name), f"initial_{name}")]
    for name in units:
        if name not in own:
            meant = did_you_mean([name], own)
            raise ArgumentError(
                f"{PLACE}, units: {name!r}; expected names of measures, outputs, parameters and initial values: "
                f"{', '.join(own)}{meant and f'; {meant}'}"
            )
