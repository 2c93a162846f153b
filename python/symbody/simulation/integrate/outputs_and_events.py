"""The expressions that are evaluated along a motion beside its state: outputs and events."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from types import MappingProxyType

from symbody.errors import ArgumentError, SimulationError
from symbody.simulation.given.closing_joint import measured_note
from symbody.simulation.given.event import Event
from symbody.simulation.given.given_input import check_explicit
from symbody.simulation.model.model import Model
from symbody.symbolic import Expr, ExprLike, free_symbols
from symbody.symbolic.given.arguments import described, expression, instead_note
from symbody.symbolic.given.namesake import namesake_note

__all__ = ["check_observed", "given_events", "given_outputs"]


def given_outputs(outputs: Mapping[str, ExprLike] | None, where: str = "simulate") -> dict[str, Expr]:
    """Return the expressions of outputs, by name.

    Raises:
        ArgumentError: the outputs are not a dictionary of names and expressions.
    """
    given: object = {} if outputs is None else outputs
    if not isinstance(given, Mapping) or any(not isinstance(name, str) for name in given):
        raise ArgumentError(
            f"{where}, outputs: {described(outputs)}; expected a dictionary of names and expressions, such as "
            "outputs={'height': z}"
        )
    return {name: expression(value, f"{where}, outputs, {name}") for name, value in given.items()}


def given_events(events: Sequence[Event] | None, where: str = "simulate") -> tuple[Event, ...]:
    """Return the events.

    Raises:
        SimulationError: the events are not a list of events.
    """
    given: object = () if events is None else events
    if isinstance(given, Event):
        raise SimulationError(f"{where}, events: one Event; expected a list of them, events=[Event(...)]")
    if isinstance(given, str | Mapping) or not isinstance(given, Iterable):
        raise SimulationError(
            f"{where}, events: {described(given)}; expected a list of them, events=[Event(expression)]"
        )
    listed = tuple(given)
    for event in listed:
        if not isinstance(event, Event):
            raise SimulationError(
                f"{where}: events contain {event!r}; expected Event(expression), from symbody"
                f"{instead_note(event)}"
            )
    return listed


def check_observed(
    model: Model,
    outputs: Mapping[str, Expr],
    events: Sequence[Event],
    where: str = "simulate",
    measures: Mapping[str, Expr] = MappingProxyType({}),
) -> None:
    """Check that inputs, outputs and events contain only variables that have values along a motion of the model.

    Args:
        model: the model.
        outputs: the outputs, by name.
        events: the events.
        where: the function that the user called.
        measures: the expressions of measures, by name.

    Raises:
        ModelError: an input brings accelerations into the equations of motion.
        SimulationError: an output or event contains another variable, which the message names.
    """
    check_explicit(model.equations, model.inputs, where)
    wanted = {f"the output {name!r}": value for name, value in outputs.items()}
    wanted |= {f"the measure {name!r}": value for name, value in measures.items()}
    wanted |= {f"the event {event}": event.expression for event in events}
    known = {*model.code_variables, *model.accelerations, *model.multipliers}
    for name, value in wanted.items():
        strange = {
            leaf for leaf in free_symbols([*model.along_motion([value])]) if leaf.depends_on_time
        } - known
        if strange:
            raise SimulationError(
                f"{where}: {name} contains {', '.join(sorted(map(str, strange)))}; expected an expression of time, "
                "coordinates, speeds, accelerations, multipliers and parameters"
                f"{measured_note(model.system, strange)}{namesake_note(strange, known, ('asked for', 'of the motion'))}"
            )
