"""Derivatives of expressions along a motion, and of the instants of events, by parameters and initial values."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from symbody.errors import ArgumentError, ParameterError, SimulationError, SymbodyError
from symbody.simulation.model.model import Model
from symbody.simulation.model.unknown import explain_unknown
from symbody.symbolic import Expr, jacobian, partial_derivative, t
from symbody.symbolic.given.arguments import brief, described
from symbody.symbolic.given.wording import joined_by_and

from .occurrence import Occurrence

__all__ = ["DifferentiatedMotion"]

Array = NDArray[np.float64]

_GRAZING = 1e-9
"""A function whose rate at its zero is below this fraction of its terms only touches zero."""


@dataclass(frozen=True, eq=False)
class DifferentiatedMotion:
    """A motion with the derivatives of its state.

    Attributes:
        model: the model.
        parameters: the values of the parameters.
        by: the k parameters and initial values by which the state is differentiated.
        t: the instants, shape (N,).
        states: the states, shape (N, n).
        slopes: S, shape (N, n, k); None if the motion was not differentiated.
        made_by: the function that made the motion, for messages.
        name: what the motion is called in messages.
    """

    model: Model
    parameters: Mapping[Expr, float]
    by: tuple[Expr, ...]
    t: Array
    states: Array
    slopes: Array | None
    made_by: str = "simulate"
    name: str = "motion"

    def sensitivity(self, expression: Expr, by: Expr) -> Array:
        """Return ``de/dp = e_x S + e_p`` at all instants, shape (N,)."""
        column, slopes = self._column(by, f"{self.name}.sensitivity")
        if expression in self.model.state:
            return slopes[:, self.model.state.index(expression), column].copy()
        e_x, e_p = self._slopes_of(expression, by, self.t, self.states)
        along: Array = np.einsum("nt,tn->t", e_x, slopes[:, :, column]) + e_p
        return along

    def instant_sensitivity(self, occurrence: Occurrence, by: Expr) -> float:
        """Return the derivative of the instant of an event: ``dt/dp = -(g_x S + g_p) / g'`` for the zero of g.

        Raises:
            ArgumentError: it is not an event of this motion.
            SimulationError: g only touches zero.
        """
        where = "motion.instant_sensitivity"
        column, _ = self._column(by, where)
        given: Any = occurrence
        if not isinstance(given, Occurrence) or given.sensitivities is None:
            raise ArgumentError(
                f"{where}: {described(given)}; expected an event of this motion, such as motion.events[0]"
            )
        at = np.array([given.t])
        states = np.array([[given.state[x] for x in self.model.state]])
        g_x, g_p = self._slopes_of(given.event.expression, by, at, states)
        terms = self._rate_terms(given.event.expression, g_x[:, 0], at, states)
        rate, size = float(terms.sum()), float(np.abs(terms).sum())
        if abs(rate) <= _GRAZING * size or size == 0:
            raise SimulationError(
                f"{where}: {given.event} only touches zero at t = {given.t:.9g} s, so that the instant has no "
                "derivative; expected an event whose expression passes zero"
            )
        return -float(g_x[:, 0] @ given.sensitivities[:, column] + g_p[0]) / rate

    def _rate_terms(self, expression: Expr, slopes: Array, at: Array, states: Array) -> Array:
        """Return the terms of the rate of an expression at one instant: ``g_x x'`` and ``g_t``."""
        model = self.model
        (value,) = model.along_motion([expression])
        rates = list(model.rates[: len(model.state)])
        function = model.function([*rates, partial_derivative(value, t)], tuple(self.parameters))
        found = np.ravel(function(at, *states.T, *self.parameters.values()))
        return np.append(slopes * found[:-1], found[-1])

    def _column(self, by: Expr, where: str) -> tuple[int, Array]:
        """Return the place of a parameter, and the sensitivities.

        Raises:
            ParameterError: the motion has no sensitivities by it.
        """
        given: Any = by
        named = brief(given) if isinstance(given, Expr) else described(given)
        if self.slopes is None:
            raise ParameterError(
                f"{where}: this motion has no sensitivities; expected {self.made_by}(..., sensitivities=[{named}])"
            )
        if not isinstance(given, Expr) or given not in self.by:
            raise ParameterError(
                f"{where}, by: {named}; expected one of the sensitivities of {self.made_by}, "
                f"{joined_by_and([str(p) for p in self.by], most=12, last='or')}"
            )
        return self.by.index(given), self.slopes

    def _slopes_of(self, expression: Expr, by: Expr, at: Array, states: Array) -> tuple[Array, Array]:
        """Return the derivatives of an expression by the state, (n, N), and by the parameter itself, (N,)."""
        model, is_parameter = self.model, by.kind == "symbol"
        (value,) = model.along_motion([expression])
        slopes = jacobian([value], [*model.state, *([by] if is_parameter else [])]).row(0)
        # The value itself is among the results, so that a variable in it that nothing knows is an error.
        try:
            function = model.function([*slopes, value], tuple(self.parameters))
        except SymbodyError as failure:
            explain_unknown("motion", [expression], model, self.parameters)
            raise SimulationError(f"motion: {failure}") from failure
        found = function(at, *states.T, *self.parameters.values())
        rows, n = np.stack([np.broadcast_to(row, at.shape) for row in found]), len(model.state)
        return rows[:n], rows[n] if is_parameter else np.zeros(len(at))
