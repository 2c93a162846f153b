"""The largest and the smallest value of an expression along the motion, and when it occurs."""

from __future__ import annotations

from dataclasses import dataclass
from typing import final

import numpy as np

from symbody.simulation.given.event import Event
from symbody.symbolic import Expr, time_derivative

from .measure import Array, Course, Measure, checked_expression

__all__ = ["maximum", "minimum"]


@final
@dataclass(frozen=True)
class Extremum(Measure):
    """The largest value among those at the instants, at the end, and where the rate passes zero.

    Attributes:
        sign: 1 for the largest value, -1 for the smallest.
    """

    sign: int

    @property
    def events(self) -> tuple[Event, ...]:
        rate = time_derivative(self.expression)
        return () if rate.is_zero else (Event(rate, direction=-self.sign),)

    @property
    def parts(self) -> tuple[str, str]:
        return ("", " instant")

    def of(self, course: Course) -> tuple[Array, ...]:
        cases, found = np.arange(len(course.end)), course.crossings
        signed = np.where(np.isnan(course.values), -np.inf, self.sign * course.values)
        place = signed.argmax(axis=1)
        best, when = signed[cases, place], course.t[place]
        at_end = self.sign * course.end > best
        best = np.where(at_end, self.sign * course.end, best)
        when = np.where(at_end, course.end_t, when)
        order = np.lexsort((found.t, -self.sign * found.value, found.case))
        own, first = np.unique(found.case[order], return_index=True)
        inner = order[first]
        is_better = self.sign * found.value[inner] > best[own]
        best[own[is_better]] = self.sign * found.value[inner[is_better]]
        when[own[is_better]] = found.t[inner[is_better]]
        return self.sign * best, when


def maximum(expression: Expr) -> Measure:
    """Return the measure ``max x(t)``, and with it the first instant at which it occurs: ``name instant``.

    Maxima between instants are located as events of the rate of x; a kink is seen at the instants of the study alone.

    >>> from symbody import functions_of_time, measures
    >>> measures.maximum(functions_of_time("x"))
    Extremum(expression=x, sign=1)
    """
    return Extremum(checked_expression(expression, "maximum"), 1)


def minimum(expression: Expr) -> Measure:
    """Return the measure ``min x(t)``, and with it the first instant at which it occurs: ``name instant``.

    >>> from symbody import functions_of_time, measures
    >>> measures.minimum(functions_of_time("x"))
    Extremum(expression=x, sign=-1)
    """
    return Extremum(checked_expression(expression, "minimum"), -1)
