"""Small motions of a motorcycle that runs straight on, in two ways, and its steady turns."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cache, cached_property

import numpy as np
from numpy.typing import NDArray

from symbody import (
    Equations,
    Expr,
    SteadyMotion,
    System,
    forward_dynamics,
    jacobian,
    lambdify,
    newton_euler,
    steady,
    time_derivative,
)
from symbody.models import ClassicSystem, flexible_motorcycle

Array = NDArray[np.float64]


@cache
def derived(system: System) -> Equations:
    """Return the equations of a system, which machines at other speeds share with their machine code."""
    return newton_euler(system)


@dataclass(frozen=True)
class Motorcycle:
    """A model, and what moves of it sideways.

    Attributes:
        model: the model, with coordinates x, y, psi, phi, delta, phir and phif.
        lateral: the names of the coordinates that straight running leaves at zero.
    """

    model: ClassicSystem
    lateral: tuple[str, ...]

    @cached_property
    def equations(self) -> Equations:
        return derived(self.model.system)

    def number(self, name: str) -> float:
        return float(self.model.parameters[self.model[name]])

    def moving(self, speed: float, lean: float = 0.0, turning: float = 0.0) -> SteadyMotion:
        """Return the motion at a speed and a lean; the torques that keep it are solved for.

        Args:
            speed: the velocity of the origin of the frame ahead, in m/s.
            lean: the roll angle, in rad; positive to the right.
            turning: a guess of the yaw rate.
        """
        at = {self.model[name]: 0.0 for name in ("x", "y", "psi")} | {self.model["phi"]: lean}
        guess = {time_derivative(self.model[f"phi{k}"]): speed / self.number(f"R{k}") for k in "rf"}
        return steady(
            self.equations,
            self.model.parameters,
            given=at | {time_derivative(self.model["x"]): speed},
            unknown=[self.model["tau"], self.model["drive"]],
            guess=guess | {time_derivative(self.model["psi"]): turning},
        )

    def linearised(self, straight: SteadyMotion) -> Array:
        """Return A of the small motions in the lateral coordinates, their rates and the states of the tyres.

        Straight running is symmetric, so that these move height, pitch and the wheels in second order alone. The
        multipliers keep their values, of which those that carry the weight turn with the wheels.
        """
        eqs = self.equations
        q, states = [self.model[name] for name in self.lateral], list(eqs.system.states)
        rates, accelerations = ([time_derivative(each, n) for each in q] for n in (1, 2))
        rows = [eqs.residuals[eqs.coordinates.index(each)] for each in q]
        known: dict[Expr, float] = {time_derivative(each, 2): 0.0 for each in eqs.coordinates}
        known |= {**straight.parameters, **straight.state, **straight.multipliers, **straight.solved}

        def slopes(entries: Sequence[Expr], variables: Sequence[Expr]) -> Array:
            found = jacobian(entries, variables)
            size = range(len(entries)), range(len(variables))
            return np.array([[found[i, j].evaluate(known) for j in size[1]] for i in size[0]])

        left = [each.evaluate(known) for each in eqs.residuals]
        assert np.abs(left).max() < 1e-7
        motion = np.linalg.solve(slopes(rows, accelerations), -slopes(rows, [*q, *rates, *states]))
        lag = slopes([eqs.state_rates[time_derivative(each)] for each in states], [*q, *rates, *states])
        n = len(q)
        return np.vstack([np.eye(n, 2 * n + len(states), n), motion, lag])

    def by_differences(self, straight: SteadyMotion) -> Array:
        """Return A of the small motions in the whole state, by central differences of machine code."""
        others, f = rates_of(self.equations)
        values = straight.parameters | straight.solved
        constants = [float(values[each]) for each in others]
        at = np.array([*straight.state.values()])
        steps = 1e-6 * np.maximum(1, np.abs(at))
        columns = []
        for k, h in enumerate(steps):
            up, down = (at + sign * h * np.eye(len(at))[k] for sign in (1, -1))
            columns.append((f(*up, *constants) - f(*down, *constants)) / (2 * h))
        return np.column_stack(columns)


@cache
def rates_of(eqs: Equations) -> tuple[list[Expr], Callable[..., Array]]:
    """Return the constants of the rates of the whole state, and their machine code."""
    solved, states = forward_dynamics(eqs), list(eqs.system.states)
    state = [*eqs.coordinates, *eqs.speeds, *states]
    written = dict(zip(eqs.multipliers, solved.multipliers, strict=True))
    rates = [eqs.state_rates[time_derivative(each)].subs(written) for each in states]
    others = [*eqs.parameters, *eqs.inputs]
    return others, lambdify([*state, *others], [*eqs.speeds, *solved.accelerations, *rates])


LATERAL = ("y", "psi", "phi", "lamda", "gamma", "v", "delta", "zeta")
"""The lateral coordinates of the flexible motorcycle."""


@cache
def flexible(speed: float) -> Motorcycle:
    """Return the flexible motorcycle with the tyres at a speed; in symbols, it is one system at all speeds."""
    model = flexible_motorcycle(speed)
    first = model if speed == 40.0 else flexible(40.0).model
    return Motorcycle(replace(model, system=first.system), LATERAL)
