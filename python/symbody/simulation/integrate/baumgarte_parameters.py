"""Baumgarte's stabilisation: the choice of the frequency with which it damps constraint violations.

`forward_dynamics` adds the damping to the equations; this file chooses its parameters for a motion.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from symbody.simulation.model.model import Model

__all__ = ["chosen_damping"]

FASTER = 10.0
"""The ratio to the fastest mode: a smaller one lets violations grow, a much larger one makes the equations stiff."""


def chosen_damping(
    model: Model, parameters: NDArray[np.float64], state: NDArray[np.float64], instants: NDArray[np.float64]
) -> tuple[float, float]:
    """Return omega and zeta for a model without stabilisation: critical damping, ten times as fast as the fastest mode.

    ``omega = 10 max(|eigenvalues of d(q', u')/d(q, u)|, 2 pi/T)`` for a motion of the duration T. This is the time
    scale that Baumgarte's parameters should have [Baumgarte 1972; Flores et al. 2011].
    """
    code, places = model.jacobian_code
    slopes = np.zeros((model.width, len(model.state)))
    slopes[tuple(zip(*places, strict=True))] = code.evaluate(
        parameters, np.concatenate([instants[:1], state])
    )
    fastest = float(np.abs(np.linalg.eigvals(slopes[: len(model.state)])).max())
    slowest = 2 * np.pi / float(instants[-1] - instants[0])
    return FASTER * max(fastest, slowest), 1.0
