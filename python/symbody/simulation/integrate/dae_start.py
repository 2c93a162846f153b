"""A consistent start of differential-algebraic equations: the rates and multipliers that belong to a state."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from symbody.errors import SimulationError

from .dae import DifferentialAlgebraicEquations

__all__ = ["Start", "start_of"]

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Start:
    """The unknowns and their rates at the first instant; mu and the rates of multipliers are set to zero."""

    t: float
    unknowns: Array
    rates: Array


def start_of(dae: DifferentialAlgebraicEquations, parameters: Array, state: Array, time: float) -> Start:
    """Return the start with a given state: speeds, accelerations, and multipliers.

    Raises:
        SimulationError: the state has the wrong length, or something is not finite there.
    """
    n, m, width = dae.differential, len(dae.model.multipliers), len(dae.unknowns)
    if state.shape != (n,):
        raise SimulationError(
            f"simulate: a state of shape {state.shape}; expected {n} numbers: "
            f"{', '.join(map(str, dae.model.state))}"
        )
    kinematics, A, b = dae.start(time, state, parameters)
    equations = [*(f"the rate of {q}" for q in dae.model.coordinates), *_equations(dae)]
    finite = np.isfinite([*kinematics, *(A.sum(axis=1) + b)])
    if not finite.all():
        strange = ", ".join(name for name, is_finite in zip(equations, finite, strict=True) if not is_finite)
        raise SimulationError(
            f"simulate: at the start, t = {time:g} s, these are not finite: {strange}; check the initial state and the "
            "parameters: a function may be out of its domain there, or a length may be zero"
        )
    solution = _solved(A, -b, _equations(dae), time)
    unknowns, rates = np.zeros(width), np.zeros(width)
    speeds = len(dae.model.speeds)
    unknowns[:n], unknowns[n : n + m] = state, solution[speeds:]
    rates[:n] = [*kinematics, *solution[:speeds], *_state_rates(dae, parameters, state, time, solution)]
    return Start(time, unknowns, rates)


def _state_rates(
    dae: DifferentialAlgebraicEquations, parameters: Array, state: Array, time: float, solution: Array
) -> Array:
    """Return the rates of the states z.

    Args:
        dae: the equations.
        parameters: the values of the parameters.
        state: coordinates, speeds and states.
        time: the time, in s.
        solution: the accelerations and multipliers.
    """
    if not dae.model.states:
        return np.zeros(0)
    (rates,) = dae.state_rates(time, state, solution, parameters)
    if not np.isfinite(rates).all():
        states = zip(dae.model.states, np.isfinite(rates), strict=True)
        strange = ", ".join(f"the rate of {z}" for z, is_finite in states if not is_finite)
        raise SimulationError(
            f"simulate: at the start, t = {time:g} s, these are not finite: {strange}; check the initial state and the "
            "parameters: a function may be out of its domain there, or a length may be zero"
        )
    return np.asarray(rates, dtype=np.float64)


def _equations(dae: DifferentialAlgebraicEquations) -> list[str]:
    model = dae.model
    return [
        *(f"the equation of motion of {q}" for q in model.system.driving),
        *(f"the acceleration of constraint {k + 1}" for k in range(len(model.constraints))),
    ]


def _solved(A: Array, right: Array, equations: Sequence[str], time: float) -> Array:
    """Return the least-norm solution; it is not the only one if constraints are dependent."""
    scale = np.abs(A).max(axis=1)
    scale[scale == 0] = 1
    solution: Array = np.linalg.lstsq(A / scale[:, None], right / scale, rcond=None)[0]
    left = np.abs(A @ solution - right) / scale
    size = (np.abs(A) @ np.abs(solution) + np.abs(right)) / scale
    worst = int(np.argmax(left))
    if left[worst] > _UNSOLVED * size.max():
        raise SimulationError(
            f"simulate: at the start, t = {time:g} s, no accelerations satisfy {equations[worst]}; expected a mass for "
            "every motion, and compatible constraints"
        )
    return solution


_UNSOLVED = 1e-6
"""The largest residual of an equation relative to its largest terms."""
