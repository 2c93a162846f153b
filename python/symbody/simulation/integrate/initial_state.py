"""The initial state of a motion, as a vector to be integrated."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from symbody.simulation.constraint.consistent import solved_state
from symbody.simulation.constraint.consistent_slopes import ConsistentStart, consistent_slopes
from symbody.simulation.constraint.kinematics import kinematics_of
from symbody.simulation.constraint.usual_states import usual_states
from symbody.simulation.given.values import state_values
from symbody.symbolic import Expr

from .task import Columns, Task

__all__ = ["initial_slopes", "initial_state", "initial_states"]


def initial_state(
    task: Task, parameters: Mapping[Expr, float], initial: Mapping[Expr, float] | None
) -> NDArray[np.float64]:
    """Return the initial state: given values, guesses, zeros, and what the constraints demand. The work is zero.

    Args:
        task: the task.
        parameters: the values of the parameters.
        initial: the given values of coordinates, rates of coordinates and speeds.

    Returns:
        Coordinates, speeds and the work, shape (model.width,).
    """
    model, t = task.unstabilized, float(task.instants[0])
    given = {**task.guess, **state_values(model.system, initial, where="simulate")}
    if model.constraints or model.system.has_quasi_velocities:
        kinematics = kinematics_of(model.equations, dict(model.inputs))
        given = solved_state(kinematics, parameters, initial, task.guess, t)
    state = np.zeros(model.width)
    state[: len(model.state)] = [given.get(name, 0.0) for name in model.state]
    return state


def initial_states(task: Task, parameters: Columns, initial: Columns, count: int) -> NDArray[np.float64]:
    """Return `initial_state` of k motions that need no further look, shape (k, model.width); NaN for the others.

    These are free motions, and those with a usual state (`usual_states`).

    Args:
        task: the task.
        parameters: the values of the parameters, one for each motion.
        initial: the given values, one for each motion.
        count: the number of motions, k.
    """
    model = task.unstabilized
    names = dict(zip(model.state, range(len(model.state)), strict=True))
    states = np.zeros((count, model.width))
    for name, place in names.items():
        states[:, place] = initial.get(name, task.guess.get(name, 0.0))
    if not (model.constraints or model.system.has_quasi_velocities):
        return states
    kinematics = kinematics_of(model.equations, dict(model.inputs))
    values = [np.broadcast_to(parameters[name], count) for name in kinematics.parameters]
    p = np.stack(values, axis=1) if values else np.empty((count, 0))
    near = state_values(model.system, task.guess, where="simulate", argument="guess")
    usual = usual_states(kinematics, p, float(task.instants[0]), initial, near)
    places = [names[name] for name in (*model.coordinates, *model.speeds)]
    states[:, places] = np.concatenate([usual.q, usual.u], axis=1)
    states[~(usual.are_found & np.isfinite(p).all(axis=1))] = np.nan
    return states


def initial_slopes(
    task: Task,
    parameters: Mapping[Expr, float],
    initial: Mapping[Expr, float] | None,
    state: NDArray[np.float64],
) -> NDArray[np.float64]:
    """Return the derivatives of the initial state by the parameters and initial values of a task, shape (n, k).

    Args:
        task: the task.
        parameters: the values of the parameters.
        initial: the given values of coordinates, rates of coordinates and speeds.
        state: the initial state.

    Raises:
        ConstraintError: the given values satisfy the constraints for these values of the parameters only.
        SimulationError: the state does not follow smoothly from what is given.
    """
    model = task.unstabilized
    if not (model.constraints or model.system.has_quasi_velocities):
        return np.array([[float(name == p) for p in task.by] for name in model.state])
    kinematics = kinematics_of(model.equations, dict(model.inputs))
    kinematics = kinematics.beside(state[len(model.state) - len(model.states) : len(model.state)])
    given = state_values(model.system, initial, where="simulate")
    start = ConsistentStart(
        kinematics, parameters, state[: len(model.state)], given, task.guess, float(task.instants[0])
    )
    return consistent_slopes(start, task.by)
