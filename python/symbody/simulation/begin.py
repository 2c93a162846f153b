"""Where a motion begins: the vector that is integrated, at the first instant."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from symbody.symbolic import Expr

from .cases import Cases
from .consistent import found_state
from .kinematics import kinematics_of
from .model import Model
from .overconstraint import check_rank
from .values import parameter_values, state_values

__all__ = ["begin", "begin_free"]


def begin(
    model: Model,
    parameters: Mapping[Expr, float],
    initial: Mapping[Expr, float],
    guess: Mapping[Expr, float],
    t: float,
) -> NDArray[np.float64]:
    """Return what is given, and zero, a guess or what the constraints demand for the rest; no work is done yet."""
    given = {
        **state_values(model.system, guess, where="simulate", argument="guess"),
        **state_values(model.system, initial, where="simulate"),
    }
    if model.constraints or model.system.has_quasi_velocities:
        kinematics = kinematics_of(model.equations, dict(model.inputs))
        given = found_state(kinematics, parameters, initial, guess, t)
    state = np.zeros(model.width)
    state[: len(model.state)] = [given.get(name, 0.0) for name in model.state]
    if model.constraints:
        kinematics = kinematics_of(model.equations, dict(model.inputs))
        p = parameter_values(kinematics.parameters, parameters)
        slopes, _ = kinematics.velocity(t, state[: len(model.coordinates)], p)
        check_rank(model, slopes[: len(model.constraints)], parameters)
    return state


def begin_free(model: Model, cases: Cases, guess: Mapping[Expr, float]) -> NDArray[np.float64]:
    """Return where many motions begin, a row each: NaN where `begin` has to look, since something is to be solved."""
    if model.constraints or model.system.has_quasi_velocities:
        return np.full((cases.count, model.width), np.nan)
    states = np.zeros((cases.count, model.width))
    for place, name in enumerate(model.state):
        states[:, place] = cases.initial.get(name, guess.get(name, 0.0))
    return states
