"""The time during which an expression is above a level, and the time after which it stays within a band."""

from __future__ import annotations

from typing import final

import numpy as np
from numpy.typing import NDArray

from symbody.errors import ArgumentError
from symbody.simulation.given.event import Event
from symbody.symbolic import Abs, Expr, ExprLike
from symbody.symbolic.given.arguments import described

from .measure import Array, Course, Indices, Measure, checked_expression, checked_number

__all__ = ["settling_time", "time_above"]

Flags = NDArray[np.bool_]

_RISING, _FALLING = 0, 1
"""The places of the events of these measures."""


class SignChange(Measure):
    """A measure that follows the sign of an expression: the events are its rising and its falling zeros."""

    @property
    def events(self) -> tuple[Event, ...]:
        return Event(self.expression, direction=1), Event(self.expression, direction=-1)


@final
class TimeAbove(SignChange):
    """The time during which the expression is positive: falling instants minus rising ones."""

    def of(self, course: Course) -> tuple[Array, ...]:
        found = course.crossings
        begin, end = found.edges(len(course.end))
        signed = np.where(found.event == _FALLING, found.t, -found.t)
        total = np.zeros(len(course.end))
        np.add.at(total, found.case, signed)
        is_above = course.end > 0
        at_start = _event_at(found.event, begin, begin < end, _FALLING, is_above)
        at_end = _event_at(found.event, end - 1, begin < end, _RISING, is_above)
        return (total + np.where(at_end, course.end_t, 0.0) - np.where(at_start, course.t[0], 0.0),)


@final
class SettlingTime(SignChange):
    """The instant of the last falling zero, if no rising one follows."""

    def of(self, course: Course) -> tuple[Array, ...]:
        found = course.crossings
        begin, end = found.edges(len(course.end))
        has_any = begin < end
        when = np.where(course.end <= 0, course.t[0], np.nan)
        when[has_any] = found.t[end[has_any] - 1]
        is_outside = _event_at(found.event, end - 1, has_any, _RISING, course.end > 0)
        return (np.where(is_outside, np.nan, when),)


def _event_at(event: Indices, places: Indices, has_any: Flags, wanted: int, otherwise: Flags) -> Flags:
    """Return whether the event at a place is the wanted one, for each case; another answer without events.

    Args:
        event: all events.
        places: which of them is asked for, for each case.
        has_any: whether a case has events.
        wanted: the event that it should be.
        otherwise: the answer for cases without events.
    """
    result = otherwise.copy()
    result[has_any] = event[places[has_any]] == wanted
    return result


def time_above(expression: Expr, level: ExprLike = 0) -> Measure:
    """Return the time during which ``x > level``, in s: the exceedance time.

    Args:
        expression: the expression x.
        level: a number, or an expression.

    >>> from symbody import functions_of_time, measures
    >>> measures.time_above(functions_of_time("x"), 0.2)
    TimeAbove(expression=x - 0.2)
    """
    return TimeAbove(
        checked_expression(expression, "time_above") - checked_number(level, "time_above, level")
    )


def settling_time(expression: Expr, band: ExprLike, target: ExprLike = 0) -> Measure:
    """Return the instant from which ``|x - target| <= band`` until the end; NaN for motions that end outside.

    Args:
        expression: the expression x.
        band: the largest distance from the target: a number, or an expression.
        target: the value to which x settles.

    Raises:
        ArgumentError: the band is not positive.

    >>> from symbody import functions_of_time, measures
    >>> measures.settling_time(functions_of_time("x"), 0.02, target=1)
    SettlingTime(expression=Abs(x - 1) - 0.02)
    """
    x, y = checked_expression(expression, "settling_time"), checked_number(target, "settling_time, target")
    width = checked_number(band, "settling_time, band")
    if width.is_number and float(width) <= 0:
        raise ArgumentError(f"measures.settling_time: band={described(band)}; expected a positive distance")
    return SettlingTime(Abs(x - y) - width)
