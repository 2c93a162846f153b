"""Driven motions, prescribed or simulated, at the instants at which loads are wanted."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from symbody.errors import ConstraintError, SimulationError
from symbody.simulation.constraint.kinematics import Kinematics
from symbody.simulation.given.values import parameter_values, state_values
from symbody.simulation.motion.motion import Motion
from symbody.symbolic import Expr, ExprLike
from symbody.symbolic.given.arguments import described

from .kinematic_analysis import Trajectory, kinematic_analysis
from .prescription import prescription_of
from .states_along import Beside, StateRates

__all__ = ["DrivenMotion", "prescribed_motion", "simulated_motion"]

Array = NDArray[np.float64]
Parameters = Mapping[Expr, ArrayLike]

_WHERE = "inverse_dynamics"


@dataclass(frozen=True, eq=False)
class DrivenMotion:
    """A motion for which loads are computed.

    Attributes:
        driving: the coordinates or quasi-velocities that are driven.
        instants: the instants, shape (N,), in s.
        trajectory: the coordinates, speeds and accelerations.
        parameters: the values of the parameters.
    """

    driving: tuple[Expr, ...]
    instants: Array
    trajectory: Trajectory
    parameters: Mapping[Expr, float]


def prescribed_motion(
    kinematics: Kinematics,
    motion: Mapping[Expr, ExprLike | ArrayLike],
    t: ArrayLike | None,
    needed: Collection[Expr],
    parameters: Parameters,
    guess: Mapping[Expr, ArrayLike] | None,
    beside: Callable[[tuple[Expr, ...], Mapping[Expr, float]], Beside | None],
) -> DrivenMotion:
    """Return the motion that a prescription and the constraints determine.

    Args:
        kinematics: the constraints.
        motion: the prescribed coordinates as functions of time.
        t: the first and the last instant, or all.
        needed: the symbols that need values, in addition to those in the prescription.
        parameters: the values of symbols.
        guess: coordinates near the first position.
        beside: returns the states beside the mechanics, of the prescribed coordinates and the values of parameters.

    Raises:
        SimulationError: instants do not increase, samples have another length, or the motion is not determined.
        ConstraintError: the constraints do not allow the motion.
        ModelError: a prescription contains something other than time and parameters.
        ParameterError: a value is missing or not finite.
    """
    instants = _instants(t)
    prescription = prescription_of(kinematics.system, motion, instants, _WHERE)
    values = _values({*needed, *prescription.parameters}, parameters)
    near = state_values(kinematics.system, guess, where=_WHERE, argument="guess", has_speeds=False)
    p = np.array([values[name] for name in kinematics.parameters])
    path, states = prescription.compiled(values), beside(prescription.coordinates, values)
    along = kinematic_analysis(kinematics, p, path, instants, near, states, _WHERE)
    return DrivenMotion(prescription.coordinates, instants, along, values)


def simulated_motion(
    kinematics: Kinematics,
    motion: Motion,
    needed: Collection[Expr],
    parameters: Parameters,
    states: StateRates,
) -> DrivenMotion:
    """Return a simulated motion. Parameters may have other values, except those in constraints and rates of states.

    Args:
        kinematics: the constraints.
        motion: the simulated motion.
        needed: the symbols that need values.
        parameters: values other than those of the motion.
        states: the rates of the states.

    Raises:
        ConstraintError: a parameter in the constraints or in the rate of a state has another value.
        ParameterError: a value is missing or not finite.
    """
    values, system = _values(needed, {**motion.parameters, **parameters}), kinematics.system
    places = dict.fromkeys(states.parameters, "the rate of a state")
    places |= dict.fromkeys(kinematics.parameters, "the constraints or the kinematics")
    for name, place in places.items():
        own = motion.parameters.get(name, values[name])
        if values[name] != own:
            raise ConstraintError(
                f"{_WHERE}, parameters: {name} = {values[name]:g} is in {place}, but the motion has {name} = {own:g}; "
                "simulate it with the same value"
            )
    q, n = len(system.coordinates), len(system.speeds)
    names = [*system.coordinates, *system.speeds, *system.accelerations, *states.states]
    rows = motion.evaluate(names).T
    along = Trajectory(rows[:, :q], rows[:, q : q + n], rows[:, q + n : q + 2 * n], rows[:, q + 2 * n :])
    return DrivenMotion(system.driving, motion.t, along, values)


def _instants(given: ArrayLike | None) -> Array:
    try:
        instants = np.atleast_1d(np.array(given, dtype=np.float64))
    except (TypeError, ValueError):
        instants = np.array([np.nan])
    is_row = instants.ndim == 1 and instants.size > 0 and np.isfinite(instants).all()
    if not is_row or (np.diff(instants) <= 0).any():
        raise SimulationError(
            f"{_WHERE}: t={described(given)}; expected the first and the last instant, or all instants, increasing"
        )
    return np.linspace(instants[0], instants[1], 1001) if len(instants) == 2 else instants


def _values(needed: Collection[Expr], parameters: Parameters) -> dict[Expr, float]:
    """Return the values of all given symbols; check that those that are needed have values."""
    names = sorted(needed, key=lambda symbol: symbol.name)
    parameter_values(names, parameters, where=_WHERE)
    return {name: float(np.asarray(value)) for name, value in parameters.items()}
