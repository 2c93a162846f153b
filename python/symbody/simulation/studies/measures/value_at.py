"""The value of an expression at one instant."""

from __future__ import annotations

from dataclasses import dataclass
from typing import final

import numpy as np

from symbody.errors import ArgumentError
from symbody.simulation.given.real import is_real
from symbody.symbolic import Expr
from symbody.symbolic.given.arguments import described

from .measure import Array, Course, Measure, checked_expression

__all__ = ["value_at"]


@final
@dataclass(frozen=True)
class ValueAt(Measure):
    """The value at one instant.

    Attributes:
        t: the instant, in s.
    """

    t: float

    @property
    def instants(self) -> tuple[float, ...]:
        return (self.t,)

    def of(self, course: Course) -> tuple[Array, ...]:
        return (course.values[:, int(np.searchsorted(course.t, self.t))],)


def value_at(expression: Expr, t: float) -> Measure:
    """Return the measure ``x(t)`` at one instant t, in s; NaN for motions that have ended before.

    Raises:
        ArgumentError: the instant is no number.

    >>> from symbody import functions_of_time, measures
    >>> measures.value_at(functions_of_time("x"), 2.5)
    ValueAt(expression=x, t=2.5)
    """
    if not is_real(t):
        raise ArgumentError(f"measures.value_at: t={described(t)}; expected an instant, in s")
    return ValueAt(checked_expression(expression, "value_at"), float(t))
