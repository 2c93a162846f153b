"""Poles of the accelerations where a motion starts, such as Euler angles at their singular position.

There the mass matrix is singular but for rounding errors: the accelerations are huge numbers that rounding decides, and
a motion from there looks finite and is wrong. At neighbouring positions the accelerations are smaller by orders.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from symbody.simulation.constraint.consistent_position import listed_values
from symbody.simulation.model.model import Model
from symbody.symbolic.given.wording import joined_by_and
from symbody.symbolic.numeric.deficiency import noting

__all__ = ["may_have_pole", "pole_at_start"]

Array = NDArray[np.float64]

_ASIDE = 1e-6
"""How far neighbouring states are, relative to each entry of the state, or to 1."""
_FALL = 1e4
"""The ratio to the accelerations of neighbouring states that makes a pole; at a simple one it is 1e10."""
_HUGE = 1e6
"""The acceleration, relative to the rates of coordinates, or to 1, below which there is no pole."""


def pole_at_start(model: Model, parameters: Array, t: float, state: Array) -> str:
    """Return which accelerations have a pole at a state, and where; the empty text if none has.

    Args:
        model: the model.
        parameters: the values of its parameters, then those of Baumgarte's stabilisation if it is used.
        t: the time, in s.
        state: coordinates, speeds and states.
    """
    n, count = len(model.coordinates), len(model.accelerations)

    def accelerations(at: Array) -> tuple[Array, float]:
        row = np.concatenate([[t], at, np.zeros(model.width - len(at))])
        with np.errstate(all="ignore"):
            rates = np.abs(model.rates_code.evaluate(parameters, row))
        return rates[n : n + count], float(max(1.0, rates[:n].max(initial=0.0)))

    here, usual = accelerations(state)
    if not count or not np.isfinite(here).all() or here.max() <= _HUGE * usual:
        return ""
    shift = _ASIDE * np.maximum(np.abs(state), 1)
    beside = np.max([accelerations(state + sign * shift)[0] for sign in (1, -1)], axis=0)
    if not np.isfinite(beside).all() or here.max() <= _FALL * beside.max():
        return ""
    poles = [str(a) for a, size in zip(model.accelerations, here, strict=True) if size > 1e-3 * here.max()]
    place = listed_values(model.coordinates, dict(zip(model.coordinates, map(float, state), strict=False)))
    return f"{joined_by_and(poles)} {'is' if len(poles) == 1 else 'are'} infinite at {place} but for rounding errors"


def may_have_pole(model: Model, parameters: Array, t: float, states: Array) -> NDArray[np.bool_]:
    """Return at which states an acceleration is so large that it may have a pole, shape (k,).

    Args:
        model: the model.
        parameters: the values of its parameters, as in `pole_at_start`, shape (k, p).
        t: the time, in s.
        states: coordinates, speeds and states, shape (k, n).
    """
    n, count = len(model.coordinates), len(model.accelerations)
    if not count:
        return np.zeros(len(states), dtype=bool)
    rows = np.zeros((len(states), 1 + model.width))
    rows[:, 0], rows[:, 1 : 1 + states.shape[1]] = t, states
    with noting(), np.errstate(all="ignore"):
        rates = np.abs(model.rates_code.evaluate_many(parameters, rows))
        usual = np.maximum(1.0, rates[:, :n].max(axis=1, initial=0.0))
        largest = rates[:, n : n + count].max(axis=1)
    return np.asarray(np.isfinite(largest) & (largest > _HUGE * usual))
