"""The kinematics of a model at one of its states."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from symbody.simulation.constraint.kinematics import Kinematics, kinematics_of
from symbody.simulation.model.model import Model
from symbody.symbolic import Expr

__all__ = ["kinematics_at"]


def kinematics_at(
    model: Model, parameters: Mapping[Expr, float], state: NDArray[np.float64]
) -> tuple[Kinematics, NDArray[np.float64]]:
    """Return the kinematics for the user's states z in a vector (q, u, z, ...), and the values of their parameters.

    Args:
        model: the model.
        parameters: the values of all parameters.
        state: the vector; what follows z is ignored, such as the work.
    """
    kinematics = kinematics_of(model.equations, dict(model.inputs))
    end = len(model.state)
    kinematics = kinematics.beside(state[end - len(model.states) : end])
    return kinematics, np.array([parameters[name] for name in kinematics.parameters])
