"""The initial state of a motion, as a vector to be integrated."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from symbody.simulation.constraint.consistent import solved_state
from symbody.simulation.constraint.consistent_slopes import ConsistentStart, consistent_slopes
from symbody.simulation.constraint.kinematics import kinematics_of
from symbody.simulation.given.values import state_values
from symbody.symbolic import Expr

from .task import Task

__all__ = ["initial_slopes", "initial_state"]


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
