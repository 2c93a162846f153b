"""States beside the mechanics along a known motion: their rates are integrated, or they are those of a simulation."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
from functools import cached_property, lru_cache

import numpy as np
from numpy.typing import NDArray

from symbody.codegen import CompiledFunction, lambdify
from symbody.dynamics import Equations
from symbody.errors import SimulationError
from symbody.simulation.given.given_input import Given, substitute_inputs
from symbody.simulation.given.parameter import parameters_among
from symbody.symbolic import Expr, free_symbols, t, time_derivative

__all__ = ["Beside", "StateRates", "integrated_states", "state_rates"]

Array = NDArray[np.float64]

_EXACT = 1e-10
"""The relative tolerance with which states are integrated along a motion."""
_TRIES, _ADVANCE = 2000, 1e-6
"""The evaluations in which the integration must advance by this part of the motion; it never ends if it doesn't."""


@dataclass(frozen=True, eq=False)
class StateRates:
    """The rates of states as functions of a motion and of the loads that are solved for.

    Attributes:
        equations: the equations of motion.
        given: the expressions that replace input functions of time.
        states: the states that are integrated.
        loads: the symbols or functions of time that are solved for.
    """

    equations: Equations
    given: Given
    states: tuple[Expr, ...]
    loads: tuple[Expr, ...]

    @cached_property
    def rates(self) -> tuple[Expr, ...]:
        """The rates, of time, coordinates, speeds, accelerations, states, loads, multipliers and parameters."""
        rates = [self.equations.state_rates[time_derivative(z)] for z in self.states]
        return substitute_inputs(self.equations.system, self.given, rates)

    @cached_property
    def parameters(self) -> tuple[Expr, ...]:
        """The symbols that need values, sorted by name."""
        return parameters_among(free_symbols(self.rates) - {*self.loads})

    @cached_property
    def hold_forces(self) -> bool:
        """Whether the rates depend on loads that are solved for, or on multipliers."""
        return bool(free_symbols(self.rates) & {*self.loads, *self.equations.multipliers})

    @cached_property
    def function(self) -> CompiledFunction:
        """The function of t, (q, u, u', z), (loads, multipliers) and p that returns the rates."""
        eqs = self.equations
        motion = [*eqs.coordinates, *eqs.speeds, *eqs.accelerations, *self.states]
        return lambdify([t, motion, [*self.loads, *eqs.multipliers], list(self.parameters)], list(self.rates))


@lru_cache(maxsize=32)
def state_rates(
    eqs: Equations, given: Given, states: tuple[Expr, ...], loads: tuple[Expr, ...]
) -> StateRates:
    """Return the rates of states. They are cached, with their compiled code."""
    return StateRates(eqs, given, states, loads)


@dataclass(frozen=True, eq=False)
class Beside:
    """The states beside a prescribed motion.

    Attributes:
        rates: their rates.
        start: their values at the first instant.
        p: the values of the parameters in the rates.
        forces: the function of the time and of (q, u, u', z) that returns loads and multipliers.
    """

    rates: StateRates
    start: Array
    p: Array
    forces: Callable[[float, Array], Array]

    def rates_at(self, time: float, motion: Array) -> Array:
        """Return the rates at an instant, of coordinates, speeds, accelerations and states."""
        known = len(self.rates.loads) + len(self.rates.equations.multipliers)
        forces = self.forces(time, motion) if self.rates.hold_forces else np.zeros(known)
        return np.asarray(self.rates.function(time, motion, forces, self.p), dtype=np.float64)


def integrated_states(beside: Beside, motion: Callable[[float], Array], instants: Array, where: str) -> Array:
    """Return the states along a motion, one row for each instant.

    Args:
        beside: the states.
        motion: the function of time that returns coordinates, speeds and accelerations.
        instants: the instants, shape (N,), in s.
        where: the function that the user called, for messages.

    Raises:
        SimulationError: the states grow beyond bounds.
    """
    from scipy.integrate import solve_ivp  # noqa: PLC0415 - slow to load, and rarely needed

    if len(instants) == 1:
        return beside.start[None]
    progress = _Progress(float(instants[0]), float(instants[-1] - instants[0]))

    def rate(time: float, z: Array) -> Array:
        value = beside.rates_at(time, np.concatenate([motion(time), z]))
        progress.note(time, value)
        return value

    span, found = (instants[0], instants[-1]), None
    with suppress(FloatingPointError):
        found = solve_ivp(rate, span, beside.start, "LSODA", instants, rtol=_EXACT, atol=_EXACT / 100)
    if found is None or not found.success:
        names = ", ".join(map(str, beside.rates.states))
        raise SimulationError(
            f"{where}: along the motion, the rates of {names} grow beyond bounds near t = {progress.reached:.3g} s; "
            "give other initial values, or prescribe another motion"
        )
    rows: Array = found.y.T
    return rows


@dataclass
class _Progress:
    """How far an integration has come."""

    reached: float
    span: float
    tries: int = 0

    def note(self, time: float, rate: Array) -> None:
        """Note an evaluation.

        Raises:
            FloatingPointError: the rate is not finite, or the integration doesn't advance.
        """
        self.tries += 1
        if time > self.reached + _ADVANCE * self.span:
            self.reached, self.tries = time, 0
        if self.tries > _TRIES or not np.isfinite(rate).all():
            raise FloatingPointError
