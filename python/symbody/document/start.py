"""The start of a motion: the numbers with which a mechanism is drawn."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from symbody.models import ClassicSystem
from symbody.symbolic import Expr


@dataclass(frozen=True)
class Start:
    """Numbers for a picture.

    Attributes:
        parameters: the values of parameters and inputs.
        position: the values of coordinates.
        guess: where the other coordinates are, about; None leaves it to the picture.
    """

    parameters: Mapping[Expr, float]
    position: Mapping[Expr, float]
    guess: Mapping[Expr, float] | None


def start_of(model: ClassicSystem, parameters: Mapping[Expr, float], position: Mapping[Expr, float]) -> Start:
    """Return the numbers of a classic system, except for those that are given.

    If a coordinate is given, the start of the model is a guess: in a closed loop, both may be impossible.
    """
    given = {q: model.initial[q] for q in model.system.coordinates if q in model.initial}
    numbers = {**model.parameters, **model.inputs, **parameters}
    if not position:
        return Start(numbers, given, model.guess)
    return Start(numbers, position, {**model.guess, **given})
