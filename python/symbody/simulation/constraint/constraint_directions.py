"""The mass matrix and the Jacobian of the constraints along a motion, as numbers."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from symbody.simulation.model.model import Model

__all__ = ["masses_and_jacobians"]

Array = NDArray[np.float64]


def masses_and_jacobians(model: Model, parameters: Array, t: ArrayLike, states: Array) -> tuple[Array, Array]:
    """Return ``M``, (k, n, n), and ``phi_q``, (k, m, n), with respect to the speeds, at k states; not always finite.

    Args:
        model: the model.
        parameters: the values of its parameters, then those of Baumgarte's stabilisation if it is used.
        t: the time in s, or one for each state.
        states: coordinates and speeds, shape (k, n_q + n).
    """
    n, m, names = len(model.speeds), len(model.constraints), (*model.parameters, *model.damping)
    entries = (*model.equations.mass_matrix.entries, *model.equations.constraint_jacobian.entries)
    with np.errstate(all="ignore"):
        values = np.asarray(model.function(entries, names)(t, *states.T, *parameters[: len(names)]))
    return values[: n * n].T.reshape(-1, n, n), values[n * n :].T.reshape(-1, m, n)
