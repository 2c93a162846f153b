"""Whether cases give a model what it needs, and nothing that it has no use for; seen before anything is run."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from symbody.errors import ParameterError
from symbody.symbolic import Expr, free_symbols, time_derivative

from .batch import Batch
from .cases import PLACE, Cases


def check_cases(batch: Batch, cases: Cases) -> None:
    """See that parameters have values, and that all values belong to something.

    Raises:
        ParameterError: a parameter without a value, or a value without a parameter, coordinate or speed.
    """
    model, given = batch.model, cases.parameters
    asked = [*batch.outputs.values(), *(event.expression for event in batch.events)]
    others = {leaf for leaf in free_symbols(asked) if leaf.kind == "symbol" and not leaf.depends_on_time}
    needed = [*model.parameters, *_by_name(others - {*model.parameters})]
    missing = [parameter for parameter in needed if parameter not in given]
    if missing:
        raise ParameterError(
            f"{PLACE}, parameters: no values for {_listed(missing)}; the parameters are {_listed(needed)}: give each "
            "a number, or a row of numbers"
        )
    known = {*needed, *model.parameters, *model.other_parameters()}
    strange = [name for name in given if name not in known]
    if strange:
        raise ParameterError(
            f"{PLACE}, parameters: {_listed(strange)} stands nowhere in the model; its parameters are "
            f"{_listed(_by_name(known))}"
        )
    _check_initial(batch, list(cases.initial))


def _check_initial(batch: Batch, given: Sequence[Expr]) -> None:
    known = [*batch.model.state, *(time_derivative(q) for q in batch.model.coordinates)]
    strange = [name for name in given if name not in known]
    if strange:
        raise ParameterError(
            f"{PLACE}, initial: {_listed(strange)} is no part of the state; expected coordinates, their rates or "
            f"speeds: {_listed(dict.fromkeys(known))}"
        )


def _by_name(symbols: Iterable[Expr]) -> list[Expr]:
    return sorted(symbols, key=lambda symbol: symbol.name)


def _listed(names: Iterable[Expr]) -> str:
    return ", ".join(map(str, names))
