"""The first instant at which an expression passes zero."""

from __future__ import annotations

from dataclasses import dataclass
from typing import final

import numpy as np

from symbody.simulation.given.event import Event
from symbody.symbolic import Expr

from .measure import Array, Course, Measure, checked_expression

__all__ = ["first_crossing"]


@final
@dataclass(frozen=True)
class FirstCrossing(Measure):
    """The instant of the first event.

    Attributes:
        direction: 1 for rising zeros, -1 for falling ones, 0 for both.
    """

    direction: int

    @property
    def events(self) -> tuple[Event, ...]:
        return (Event(self.expression, direction=self.direction),)

    def of(self, course: Course) -> tuple[Array, ...]:
        when = np.full(len(course.end), np.nan)
        own, first = np.unique(course.crossings.case, return_index=True)
        when[own] = course.crossings.t[first]
        return (when,)


def first_crossing(expression: Expr, direction: int = 0) -> Measure:
    """Return the first instant at which an expression passes zero, such as ``x - limit``; NaN if it never does.

    Args:
        expression: the expression.
        direction: 1 for rising zeros, -1 for falling ones, 0 for both.

    Raises:
        SimulationError: the direction is none of these.

    >>> from symbody import functions_of_time, measures
    >>> measures.first_crossing(functions_of_time("x") - 0.1, direction=1)
    FirstCrossing(expression=x - 0.1, direction=1)
    """
    found = FirstCrossing(checked_expression(expression, "first_crossing"), direction)
    _ = found.events
    return found
