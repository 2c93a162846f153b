"""Angles that are known from -pi to pi, continued along motions over any number of turns."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from symbody.errors import SimulationError
from symbody.multibody.joint.freedom import Freedom
from symbody.symbolic import Expr

__all__ = ["values_along"]

Array = NDArray[np.float64]

_KNOWN = np.pi / 2
"""The largest error of a prediction at which the number of turns is not in doubt."""


def values_along(
    freedom: Freedom, t: Array, evaluate: Callable[[list[Expr]], Array], name: str = "motion"
) -> Array:
    """Return the values of a freedom along motions, in which angles have no jumps, shape (..., N).

    Args:
        freedom: the freedom.
        t: the instants, shape (N,).
        evaluate: returns the values of expressions, shape (expressions, ..., N).
        name: of the result, for messages.

    Raises:
        SimulationError: the instants are too far apart to count the turns between them.
    """
    if not freedom.jumps:
        values: Array = evaluate([freedom.value])[0]
        return values
    angle, rate = evaluate([freedom.value, freedom.rate])
    turned, error = _turned(np.diff(t), angle, rate)
    in_doubt = np.argwhere(error > _KNOWN)
    if in_doubt.size:
        *cases, k = in_doubt[0].tolist()
        raise SimulationError(
            f"{name}[...]: {freedom} can't be followed {''.join(f'in case {case} ' for case in cases)}from "
            f"t = {t[k]:.6g} s to {t[k + 1]:.6g} s, between which it may make a turn more or less; expected instants "
            "that are closer together, t=np.linspace(...), or freedom.value, which is known from -pi to pi"
        )
    start = angle[..., :1]
    return np.concatenate([start, start + np.cumsum(turned, axis=-1)], axis=-1)


def _turned(h: Array, angle: Array, rate: Array) -> tuple[Array, Array]:
    """Return by how much angles turn in each interval h, with whole turns, and how large the error of that may be.

    The turns are those by which an angle comes closest to ``a0 + h (a0' + a1')/2``.
    """
    predicted = h * (rate[..., 1:] + rate[..., :-1]) / 2
    steps = np.diff(angle)
    turned = steps + 2 * np.pi * np.round((predicted - steps) / (2 * np.pi))
    spread = h * np.abs(np.diff(rate)) / 2  # bounds the error if the rate is between both of its values
    return turned, np.maximum(np.abs(predicted - turned), spread)
