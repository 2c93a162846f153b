"""Occurrences: the events that occurred along a motion."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import NoReturn

import numpy as np
from numpy.typing import NDArray

from symbody.errors import ArgumentError
from symbody.simulation.given.event import Event
from symbody.symbolic import Expr
from symbody.symbolic.given.arguments import brief

__all__ = ["Occurrence"]


@dataclass(frozen=True)
class Occurrence:
    """An event that occurred.

    Attributes:
        event: the event.
        t: the instant, in s.
        state: the coordinates and speeds at that instant.
        sensitivities: the derivatives of the state there by the parameters of `simulate(..., sensitivities=[...])` at a
            fixed time, shape (n, k); None without these.

    >>> from symbody import Body, System, functions_of_time, newton_euler, simulate, time_derivative, translate
    >>> x = functions_of_time("x")
    >>> body = newton_euler(System([Body(translate(x, 0, 0), 1)], coordinates=[x]))
    >>> motion = simulate(body, {}, {time_derivative(x): 2}, t=(0, 1), events=[Event(x - 1)])
    >>> [round(occurrence.t, 9) for occurrence in motion.events]
    [0.5]
    """

    event: Event
    t: float
    state: Mapping[Expr, float]
    sensitivities: NDArray[np.float64] | None = field(default=None, repr=False, compare=False)

    def __repr__(self) -> str:
        return f"Occurrence({brief(self.event)} at t = {self.t:.6g})"

    def __getitem__(self, expression: object) -> NoReturn:
        """Refuse brackets: the motion has the values of expressions at its events."""
        raise ArgumentError(
            f"occurrence[...]: an event has a state, occurrence.state[{brief(str(expression))}]; of other expressions, "
            "motion.at_events[expression] has one value for each of motion.events"
        )
