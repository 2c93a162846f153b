"""The mass matrix and the derivatives of the constraints along a motion, as numbers."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from symbody.simulation.model.model import Model

__all__ = ["masses_and_slopes"]

Array = NDArray[np.float64]


def masses_and_slopes(model: Model, parameters: Array, t: ArrayLike, states: Array) -> tuple[Array, Array]:
    """Return ``M``, k x n x n, and ``phi_q``, k x m x n, by the speeds, at k states; whatever isn't finite stays so.

    Args:
        model: what moves.
        parameters: the values of its parameters, and behind them those of the stabilisation, if there is one.
        t: the time in s, or one for each state.
        states: coordinates and speeds, a row for each.
    """
    n, m, names = len(model.speeds), len(model.constraints), (*model.parameters, *model.damping)
    entries = (*model.equations.mass_matrix.entries, *model.equations.constraint_jacobian.entries)
    with np.errstate(all="ignore"):
        values = np.asarray(model.function(entries, names)(t, *states.T, *parameters[: len(names)]))
    return values[: n * n].T.reshape(-1, n, n), values[n * n :].T.reshape(-1, m, n)
