"""Measures: numbers that sum up a motion, such as a final value or a maximum."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from symbody.errors import ArgumentError
from symbody.simulation.given.event import Event
from symbody.symbolic import Expr
from symbody.symbolic.given.arguments import described, instead_note
from symbody.symbolic.given.arguments import expression as given_expression

__all__ = ["Course", "Crossings", "Measure", "checked_expression", "checked_number"]

Array = NDArray[np.float64]
Indices = NDArray[np.intp]


@dataclass(frozen=True, eq=False)
class Crossings:
    """The occurrences of the events of a measure in k motions, by case and then by instant.

    Attributes:
        case: the case of each.
        event: which of the events of the measure it is.
        t: its instant, in s.
        value: the value of the measured expression there.
    """

    case: Indices
    event: Indices
    t: Array
    value: Array

    def edges(self, cases: int) -> tuple[Indices, Indices]:
        """Return where the crossings of each case begin and end, shape (k,) each."""
        number = np.arange(cases)
        return np.searchsorted(self.case, number, "left"), np.searchsorted(self.case, number, "right")


@dataclass(frozen=True, eq=False)
class Course:
    """What a measure knows of k motions. Values after the end of a motion are NaN.

    Attributes:
        t: the instants, shape (N,), in s.
        values: the measured expression there, shape (k, N).
        end_t: the last instant of each motion, shape (k,).
        end: the measured expression there, shape (k,).
        integral: the integral of the measure's integrand, shape (k,); NaN if it has none.
        crossings: the occurrences of the measure's events.
    """

    t: Array
    values: Array
    end_t: Array
    end: Array
    integral: Array
    crossings: Crossings


@dataclass(frozen=True)
class Measure(ABC):
    """A number, or several, that sum up a motion; computed from what the compiled integrator provides.

    Attributes:
        expression: the expression that is measured.
    """

    expression: Expr

    @property
    def events(self) -> tuple[Event, ...]:
        """The events that the integrator locates for this measure."""
        return ()

    @property
    def integrand(self) -> Expr | None:
        """The rate of a state that is integrated with the motion, from zero."""
        return None

    @property
    def instants(self) -> tuple[float, ...]:
        """The instants at which the expression is needed, in s, beside the first and the last one."""
        return ()

    @property
    def parts(self) -> Sequence[str]:
        """What is appended to the name of the measure for each of its numbers."""
        return ("",)

    @abstractmethod
    def of(self, course: Course) -> tuple[Array, ...]:
        """Return the numbers of k motions, an array of shape (k,) for each of the parts."""


def checked_expression(value: object, where: str) -> Expr:
    """Return the expression of a measure.

    Raises:
        ArgumentError: it is none.
    """
    if not isinstance(value, Expr):
        raise ArgumentError(
            f"measures.{where}: {described(value)}; expected an expression of the motion, such as x - h"
            f"{instead_note(value)}"
        )
    return value


def checked_number(value: object, where: str) -> Expr:
    """Return an argument of a measure that is a number or an expression.

    Args:
        value: what the user gave.
        where: the function and the argument, such as ``time_above, level``.

    Raises:
        ArgumentError: it is something else.
    """
    return given_expression(value, f"measures.{where}")
