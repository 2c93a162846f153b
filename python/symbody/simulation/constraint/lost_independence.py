"""Where independent speeds no longer determine the others: embedded equations divide by zero there."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from symbody.simulation.model.model import Model
from symbody.symbolic import Expr, time_derivative

from .zeros_along import course_of, zeros_along

__all__ = ["lost_independence"]

Array = NDArray[np.float64]

STEEP = 0.5
"""The least ratio of sizes at the ends of steps where none vanishes between them: steps are short before an infinite
rate."""


def lost_independence(model: Model, parameters: Mapping[Expr, float], trail: Array) -> tuple[Array, str]:
    """Return the instants, in s, at which rates of coordinates by the speeds, ``q' = K u + k``, are infinite.

    There the inverse of the largest singular value of K vanishes. The text names the speed and the rate that it does
    not determine at the first instant.

    Args:
        model: the model of embedded equations.
        parameters: the values of its parameters.
        trail: the instant, the coordinates and the speeds at the ends of steps, one row for each.
    """
    nowhere = np.empty(0), ""
    if len(trail) < 2 or not model.system.eliminated_constraints or not model.speeds:
        return nowhere
    p = np.array([parameters[name] for name in (*model.parameters, *model.damping)])
    at_steps = _sizes(_slopes(model, p, trail[:, 0], trail[:, 1 : 1 + len(model.state)]))
    if np.nanmin(at_steps, initial=np.inf) > STEEP * np.nanmax(at_steps, initial=0.0):
        return nowhere
    course = course_of(model, p, trail)
    if course is None:
        return nowhere
    at = zeros_along(lambda t: _sizes(_slopes(model, p, t, course.states(t))), course.instants)
    if not len(at):
        return nowhere
    (slopes,) = np.abs(_slopes(model, p, at[:1], course.states(at[:1])))
    rate, speed = np.unravel_index(int(np.argmax(slopes)), slopes.shape)
    coordinate = time_derivative(model.coordinates[rate])
    return at, f"{model.speeds[speed]} does not determine {coordinate}"


def _sizes(slopes: Array) -> Array:
    """Return the inverse of the largest singular value at each state, at most 1; NaN where it isn't known."""
    is_fit = np.isfinite(slopes).all(axis=(1, 2))
    found = np.full(len(slopes), np.nan)
    found[is_fit] = 1 / np.maximum(np.linalg.norm(slopes[is_fit], ord=2, axis=(1, 2)), 1.0)
    return found


def _slopes(model: Model, parameters: Array, t: Array, states: Array) -> Array:
    """Return K at k states, (k, n_q, n): the rates are linear in the speeds."""
    n, first = len(model.speeds), len(model.coordinates)
    function = model.function(model.coordinate_rates, (*model.parameters, *model.damping))
    still = states.copy()
    still[:, first : first + n] = 0.0

    def rates(place: int | None) -> Array:
        moving = still.copy()
        if place is not None:
            moving[:, first + place] = 1.0
        with np.errstate(all="ignore"):
            return np.asarray(function(t, *moving.T, *parameters)).T

    rest = rates(None)
    return np.stack([rates(k) - rest for k in range(n)], axis=2)
