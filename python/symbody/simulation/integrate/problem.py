"""The interface to the native integrator: compiled functions, by their addresses."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from symbody.codegen import PreparedCode
from symbody.simulation.given.event import Event
from symbody.symbolic import Expr
from symbody.symbolic._core import Dynamics, tableau

__all__ = ["Problem", "Tableau", "tableau_of"]

_Code: TypeAlias = tuple[int, int, int, tuple[int, int] | None]
_Rows: TypeAlias = list[list[tuple[int, float]]]


class Tableau(NamedTuple):
    """The coefficients of an explicit Runge-Kutta method, as the native integrator has them.

    Attributes:
        order: the power of the step that the error estimate is proportional to.
        stages: how many stages make a step; the stage after them is at its end, further ones serve the dense output.
        evaluates_end: whether the error estimate needs the rates at the end of the step.
        stability: the product of step and eigenvalue at which the method becomes unstable, a little less.
        c: when the stages are, in steps.
        a: the places and values of the weights of the earlier stages in each stage.
        errors: the same in the estimates of the error.
        dense: the same in the terms of the dense output beyond the cubic Hermite polynomial.
    """

    order: int
    stages: int
    evaluates_end: bool
    stability: float
    c: list[float]
    a: _Rows
    errors: _Rows
    dense: _Rows


def tableau_of(method: str) -> Tableau:
    """Return the coefficients of an explicit method.

    >>> tableau_of("tsit5").order
    5
    """
    found = tableau(method)
    assert found is not None, "only explicit methods have coefficients"
    return Tableau(*found)


@dataclass(frozen=True, eq=False)
class Problem:
    """The compiled functions of an integration.

    Attributes:
        width: the length of the integrated vector.
        controlled: the number of its entries that enter the error estimate.
        rates: the rates of the vector.
        jacobian: their nonzero derivatives, with rows and columns; for implicit methods.
        corrections: the corrections of coordinates and of speeds onto the constraints; None without projection.
        of_sensitivities: the correction of sensitivities, and their first place; None without one of these.
        energies: the kinetic and the potential energy; None where their sum is not constant.
        events: the functions whose zeros are events, and the events.
        trail: the most states at the ends of steps that are kept for each motion; of longer motions, every second or
            fourth state is kept, and so on.
    """

    width: int
    controlled: int
    rates: PreparedCode
    jacobian: tuple[PreparedCode, list[tuple[int, int]]] | None = None
    corrections: tuple[PreparedCode, PreparedCode] | None = None
    of_sensitivities: tuple[PreparedCode, int] | None = None
    energies: PreparedCode | None = None
    events: tuple[PreparedCode, tuple[Event, ...]] | None = None
    trail: int = 0

    @property
    def codes(self) -> list[PreparedCode]:
        """All functions, in the order of their constants."""
        jacobian = [] if self.jacobian is None else [self.jacobian[0]]
        events = [] if self.events is None else [self.events[0]]
        energies = [] if self.energies is None else [self.energies]
        of_sensitivities = [] if self.of_sensitivities is None else [self.of_sensitivities[0]]
        return [self.rates, *jacobian, *(self.corrections or ()), *of_sensitivities, *energies, *events]

    @property
    def parameters(self) -> tuple[Expr, ...]:
        """The symbols that need values: the parameters of the rates, then those that only events contain."""
        return self.codes[-1].parameters

    def constants(self, parameters: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the constants of all functions for given parameters, one after another."""
        return np.concatenate([code.prepare(parameters[: len(code.parameters)]) for code in self.codes])

    def constants_of_many(self, parameters: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the constants for k sets of parameters, in rows."""
        parts = [code.prepare_many(parameters[:, : len(code.parameters)]) for code in self.codes]
        return np.concatenate(parts, axis=1)

    @cached_property
    def native(self) -> Dynamics:
        """The functions, by their addresses."""
        return self._by_address(_alone)

    @cached_property
    def in_lanes(self) -> Dynamics:
        """The functions, with those of several states where there are any."""
        return self._by_address(_in_lanes)

    def _by_address(self, code_of: Callable[[PreparedCode], _Code]) -> Dynamics:
        positions, velocities = self.corrections or (None, None)
        slopes = self.of_sensitivities
        return Dynamics(
            code_of(self.rates),
            None if self.jacobian is None else (_alone(self.jacobian[0]), self.jacobian[1]),
            None if positions is None else code_of(positions),
            None if velocities is None else code_of(velocities),
            None if self.energies is None else code_of(self.energies),
            None
            if self.events is None
            else (code_of(self.events[0]), [(event.direction, event.terminal) for event in self.events[1]]),
            *([] if slopes is None else [(code_of(slopes[0]), slopes[1])]),
        )


def _alone(code: PreparedCode) -> _Code:
    return code.address, code.constants, len(code.expressions), None


def _in_lanes(code: PreparedCode) -> _Code:
    return code.address, code.constants, len(code.expressions), code.in_lanes
