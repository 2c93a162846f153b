"""Events: what happens where an expression passes zero."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from symbody.errors import SimulationError
from symbody.symbolic import Expr
from symbody.symbolic.given.arguments import described

__all__ = ["Event", "Occurrence"]


@dataclass(frozen=True)
class Event:
    """A condition that a simulation looks for.

    Attributes:
        expression: what passes zero: of time, coordinates, speeds, accelerations, multipliers and parameters.
        direction: 1 where it rises through zero, -1 where it falls, 0 for both.
        terminal: whether the motion ends there.
        name: what to call it; by default the expression's text.

    Raises:
        SimulationError: another direction, or no expression.
    """

    expression: Expr
    direction: int = 0
    terminal: bool = False
    name: str = ""

    def __post_init__(self) -> None:
        if not isinstance(self.expression, Expr):
            raise SimulationError(
                f"Event: {described(self.expression)}; expected an expression that passes zero, such as z - h"
            )
        if self.direction not in {-1, 0, 1}:
            raise SimulationError(
                f"Event: direction={self.direction!r}; expected 1 (rising through zero), -1 (falling) or 0 (both)"
            )

    def __str__(self) -> str:
        return self.name or str(self.expression)


@dataclass(frozen=True)
class Occurrence:
    """An event that happened.

    Attributes:
        event: which.
        t: when, in s.
        state: the coordinates and speeds there.
    """

    event: Event
    t: float
    state: Mapping[Expr, float]
