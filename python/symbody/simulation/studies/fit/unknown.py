"""The unknowns of a fit: parameters and initial values, with their bounds."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import inf

import numpy as np
from numpy.typing import NDArray

from symbody.errors import ArgumentError, ParameterError
from symbody.simulation.given.real import is_real
from symbody.symbolic import Expr
from symbody.symbolic.given.arguments import described

from .experiment import Experiment

__all__ = ["Unknown", "unknowns_of"]

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Unknown:
    """A parameter or an initial value that is estimated.

    Attributes:
        name: the parameter, or the variable whose initial value it is.
        experiment: the number of the experiment that has it alone; None if all of them share it.
        start: where the search starts.
        low: its lower bound.
        high: its upper bound.
    """

    name: Expr
    experiment: int | None
    start: float
    low: float = -inf
    high: float = inf

    def __str__(self) -> str:
        initial = "" if self.name.kind == "symbol" else "initial "
        return f"{initial}{self.name}" + (
            "" if self.experiment is None else f" of experiment {self.experiment}"
        )

    def is_in(self, experiment: int) -> bool:
        """Return whether an experiment depends on it."""
        return self.experiment in (None, experiment)


def unknowns_of(shared: object, experiments: Sequence[Experiment]) -> list[Unknown]:
    """Return all unknowns: those that the experiments share, then those of each.

    Raises:
        ArgumentError: a key is no variable, or a value is neither a start nor a start with bounds.
        ParameterError: there are none, a start is beyond its bounds, or a name is unknown and given.
    """
    found = _read(shared, None, "fit, unknown")
    for number, experiment in enumerate(experiments):
        own = _read(experiment.unknown, number, f"fit, unknown of experiment {number}")
        found += own
        given = {**experiment.parameters, **experiment.initial}
        names = [each.name for each in found if each.is_in(number)]
        both = next((name for name in names if name in given or names.count(name) > 1), None)
        if both is not None:
            raise ParameterError(
                f"fit: {both} of experiment {number} is unknown and given, or unknown twice; leave one of them out"
            )
    if not found:
        raise ParameterError("fit: nothing is unknown; give unknown={k: 100.0}")
    return found


def _read(given: object, experiment: int | None, place: str) -> list[Unknown]:
    if not isinstance(given, Mapping):
        raise ArgumentError(
            f"{place}: {described(given)}; expected a dictionary of variables, with a start or (start, low, high) each"
        )
    return [_one(name, value, experiment, place) for name, value in given.items()]


def _one(name: object, value: object, experiment: int | None, place: str) -> Unknown:
    if not isinstance(name, Expr) or not name.is_variable:
        raise ArgumentError(f"{place}: the key {described(name)}; expected a symbol or a function of time")
    numbers = value if isinstance(value, tuple | list) else (value, -inf, inf)
    if (
        len(numbers) != 3
        or not is_real(numbers[0])
        or not all(isinstance(x, int | float) for x in numbers[1:])
    ):
        raise ArgumentError(
            f"{place}, {name}: {described(value)}; expected a start, or (start, low, high), such as (1.0, 0, inf)"
        )
    start, low, high = (float(x) for x in numbers)
    if not low < high or not low <= start <= high:
        raise ParameterError(
            f"{place}, {name}: ({start:g}, {low:g}, {high:g}); expected low <= start <= high"
        )
    return Unknown(name, experiment, start, low, high)
