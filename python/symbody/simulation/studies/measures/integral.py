"""Integrals of an expression along the motion, which are integrated with it: costs, averages, effective values."""

from __future__ import annotations

from dataclasses import dataclass
from typing import final

import numpy as np

from symbody.symbolic import Expr

from .measure import Array, Course, Measure, checked_expression

__all__ = ["average", "integral", "rms"]


@final
class Integral(Measure):
    """The integral over time, in the error estimate of the steps like the state."""

    @property
    def integrand(self) -> Expr:
        return self.expression

    def of(self, course: Course) -> tuple[Array, ...]:
        return (course.integral,)


@final
@dataclass(frozen=True)
class PowerMean(Measure):
    """The power mean ``(1/T integral of x^p)^(1/p)``.

    Attributes:
        power: p, 1 or 2.
    """

    power: int

    @property
    def integrand(self) -> Expr:
        return self.expression**self.power

    def of(self, course: Course) -> tuple[Array, ...]:
        duration = course.end_t - course.t[0]
        with np.errstate(invalid="ignore", divide="ignore"):
            mean = course.integral / duration
        return (mean if self.power == 1 else np.sqrt(np.maximum(mean, 0.0)),)


def integral(expression: Expr) -> Measure:
    """Return the measure ``integral of x dt`` from the first instant to the end: a cost, a work, a distance.

    >>> from symbody import functions_of_time, measures
    >>> measures.integral(functions_of_time("x") ** 2)
    Integral(expression=x**2)
    """
    return Integral(checked_expression(expression, "integral"))


def average(expression: Expr) -> Measure:
    """Return the measure ``1/T integral of x dt`` over the duration T of the motion.

    >>> from symbody import functions_of_time, measures
    >>> measures.average(functions_of_time("x"))
    PowerMean(expression=x, power=1)
    """
    return PowerMean(checked_expression(expression, "average"), 1)


def rms(expression: Expr) -> Measure:
    """Return the effective value (root mean square) ``sqrt(1/T integral of x^2 dt)`` over the duration T.

    >>> from symbody import functions_of_time, measures
    >>> measures.rms(functions_of_time("x"))
    PowerMean(expression=x, power=2)
    """
    return PowerMean(checked_expression(expression, "rms"), 2)
