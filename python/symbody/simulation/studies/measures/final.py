"""The final value of an expression."""

from __future__ import annotations

from typing import final as no_subclass

from symbody.symbolic import Expr

from .measure import Array, Course, Measure, checked_expression

__all__ = ["final"]


@no_subclass
class Final(Measure):
    """The value at the end of the motion: at the last instant, or at a terminal event."""

    def of(self, course: Course) -> tuple[Array, ...]:
        return (course.end,)


def final(expression: Expr) -> Measure:
    """Return the measure ``x(T)``: the value at the last instant, or at the terminal event that ended the motion.

    >>> from symbody import functions_of_time, measures
    >>> measures.final(functions_of_time("x"))
    Final(expression=x)
    """
    return Final(checked_expression(expression, "final"))
