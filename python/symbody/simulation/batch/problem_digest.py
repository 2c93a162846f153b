"""Digests of a problem: equal digests mean equal results."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping

import numpy as np
from numpy.typing import NDArray

from symbody.simulation.integrate.task import Task
from symbody.symbolic import Expr

from .cases import Cases
from .results_file import digest


def problem_digest(task: Task, cases: Cases) -> dict[str, str]:
    """Return the digest of each part of a problem, by the name of the part.

    Expressions enter by name or by their values at a random point: these are the same on all machines, and for all
    ways of writing an expression.
    """
    model = task.model
    equations = [
        *model.equations.derived_residuals,
        *model.constraints,
        *model.coordinate_rates,
        *model.state_rates,
    ]
    events = [f"{event.direction} {event.terminal}" for event in task.events]
    return {
        "the equations": digest([*map(str, model.state), "=", *_values(equations)]),
        "the inputs": digest(_named({str(name): value for name, value in model.inputs})),
        "the outputs": digest(_named(task.outputs)),
        "the events": digest([*events, *_values(event.expression for event in task.events)]),
        "the parameters": digest(_columns(cases.parameters)),
        "the initial values": digest(_columns(cases.initial)),
        "the instants": digest([task.instants.astype("<f8").tobytes()]),
        "the options": digest(_options(task)),
    }


def _values(expressions: Iterable[Expr]) -> Iterator[bytes]:
    return (expression.fingerprint for expression in expressions)


def _named(expressions: Mapping[str, Expr]) -> Iterator[str | bytes]:
    for name, expression in expressions.items():
        yield name
        yield expression.fingerprint


def _columns(columns: Mapping[Expr, NDArray[np.float64]]) -> Iterator[str | bytes]:
    for name in sorted(columns, key=str):
        yield str(name)
        yield columns[name].astype("<f8").tobytes()


def _options(task: Task) -> Iterator[str]:
    yield repr(task.options)
    yield repr(task.constraints)
    yield repr(task.keeps_states)
    yield from (f"by {name}" for name in task.by)
    yield from (f"{name} {value!r}" for name, value in sorted(_texts(task.guess).items()))


def _texts(values: Mapping[Expr, float]) -> dict[str, float]:
    return {str(name): float(value) for name, value in values.items()}
