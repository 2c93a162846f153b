"""The frequency with which Baumgarte's stabilisation damps what is off the constraints, from the motion's own."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from symbody.simulation.model.model import Model

__all__ = ["chosen_damping"]

FASTER = 10.0
"""How much faster than the motion: slower lets violations grow, much faster makes the equations stiff."""


def chosen_damping(
    model: Model, parameters: NDArray[np.float64], state: NDArray[np.float64], instants: NDArray[np.float64]
) -> tuple[float, float]:
    """Return omega and zeta for a model that isn't stabilised yet: critical, ten times as fast as its fastest mode.

    ``omega = 10 max(|eigenvalues of d(q', u')/d(q, u)|, 2 pi/T)`` for a motion of the duration T: the time scale by
    which Baumgarte's parameters should be chosen [Baumgarte 1972; Flores et al. 2011].
    """
    code, places = model.jacobian_code
    slopes = np.zeros((model.width, len(model.state)))
    slopes[tuple(zip(*places, strict=True))] = code.evaluate(
        parameters, np.concatenate([instants[:1], state])
    )
    fastest = float(np.abs(np.linalg.eigvals(slopes[: len(model.state)])).max())
    slowest = 2 * np.pi / float(instants[-1] - instants[0])
    return FASTER * max(fastest, slowest), 1.0
