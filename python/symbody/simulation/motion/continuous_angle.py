"""Angles that are known from -pi to pi, continued along a motion over any number of turns."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from symbody.errors import SimulationError

if TYPE_CHECKING:
    from symbody.multibody.joint.freedom import Freedom

__all__ = ["continuous"]

Array = NDArray[np.float64]

_KNOWN = np.pi / 2
"""The largest error of a prediction at which the number of turns is not in doubt."""


def continuous(freedom: Freedom, t: Array, angle: Array, rate: Array) -> Array:
    """Return an angle with whole turns added, so that it begins as it is and has no jumps.

    The turns between two instants are those by which it comes closest to ``a0 + (t1 - t0) (a0' + a1')/2``.

    Args:
        freedom: the freedom, for messages.
        t: the instants, shape (N,).
        angle: the values at them, from -pi to pi.
        rate: their rates.

    Raises:
        SimulationError: the instants are too far apart to count the turns between them.
    """
    predicted = np.diff(t) * (rate[1:] + rate[:-1]) / 2
    steps = np.diff(angle)
    turned = steps + 2 * np.pi * np.round((predicted - steps) / (2 * np.pi))
    spread = (
        np.diff(t) * np.abs(np.diff(rate)) / 2
    )  # bounds the error if the rate is between both of its values
    in_doubt = np.flatnonzero(np.maximum(np.abs(predicted - turned), spread) > _KNOWN)
    if in_doubt.size:
        k = in_doubt[0]
        raise SimulationError(
            f"motion[...]: {freedom} can't be followed from t = {t[k]:.6g} s to {t[k + 1]:.6g} s, between which it may "
            "make a turn more or less; expected instants that are closer together, t=np.linspace(...), or "
            "freedom.value, which is known from -pi to pi"
        )
    return np.concatenate([angle[:1], angle[0] + np.cumsum(turned)])
