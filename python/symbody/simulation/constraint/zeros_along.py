"""Where a size vanishes along a motion, between the ends of its steps, too."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from symbody.simulation.model.model import Model

__all__ = ["Course", "course_of", "zeros_along"]

Array = NDArray[np.float64]

SINGULAR, REGULAR = 0.02, 0.06
"""The ratios to its largest value along the motion below which a size is zero, and above which it is not."""
PARTS, MARGIN = 2, 2.0
"""The number of parts of a step in the search for zeros, and by how many intervals the zero of a line through two
values may be off."""
ROUNDS, FINER = 2, 16
"""The number of times that the intervals next to a minimum are divided again, and the parts of each division."""
SHORT = 1e-9
"""The part of the duration below which two steps count as one."""


class Course(NamedTuple):
    """The states of a motion at any instant.

    Attributes:
        instants: those at which zeros are looked for first: some for each step.
        states: returns the states at instants.
    """

    instants: Array
    states: Callable[[Array], Array]


def course_of(model: Model, parameters: Array, trail: Array) -> Course | None:
    """Return the course of a motion; None if less than two steps of it are known.

    Between steps the coordinates are interpolated by cubic polynomials with their values and rates.

    Args:
        model: the model.
        parameters: the values of its parameters, including those of Baumgarte's stabilisation.
        trail: the instant, the coordinates and the speeds at the ends of steps, one row for each.
    """
    ends, states, rates = _finite(model, parameters, _thinned(trail))
    if len(ends) < 2:
        return None
    t = np.append(_divided(ends[:-1], ends[1:], PARTS)[:, :-1], ends[-1])
    return Course(t, _interpolation(ends, states, rates))


def zeros_along(size: Callable[[Array], Array], t: Array) -> Array:
    """Return the instants at which a size that isn't negative vanishes, or nearly so, beside its largest value.

    Args:
        size: returns its values at instants, NaN where they are not known.
        t: instants, at least some for each step.
    """
    found = size(t)
    largest = np.nanmax(found, initial=0.0)
    if largest == 0:
        return np.empty(0)
    found = found / largest
    places = 1 + np.flatnonzero(_may_vanish(t, found) | (found[1:-1] < SINGULAR))
    at, least = _minima(size, t[places - 1], t[places + 1])
    is_passed = least < SINGULAR * largest
    # Minima without regular positions between them belong to one passage: a motion may stay there.
    regular = np.searchsorted(t[found > REGULAR], at[is_passed])
    return at[is_passed][np.unique(regular, return_index=True)[1]]


def _thinned(trail: Array) -> Array:
    """Return the ends of steps in order, at most one in each of `SHORT` equal parts of the time.

    Where a method cannot continue, thousands of its steps lie at one instant.
    """
    t = trail[:, 0]
    begin, span = t.min(initial=np.inf), np.ptp(t) if len(t) else 0.0
    kept: Array = trail[np.unique(np.floor((t - begin) / (SHORT * span or 1.0)), return_index=True)[1]]
    return kept


def _may_vanish(t: Array, ratio: Array) -> NDArray[np.bool_]:
    """Return whether a ratio may vanish next to its minima, for each instant but the first and the last.

    The ratio is proportional to the distance from its zero. So the zero is in the interval on one side if the line
    through the values on the other side vanishes there.
    """
    h, change = np.diff(t), np.diff(ratio)
    here, fall, rise = ratio[1:-1], -change[:-1], change[1:]
    later, earlier = here * h[:-1] <= MARGIN * fall * h[1:], here * h[1:] <= MARGIN * rise * h[:-1]
    # No comparison with NaN is true.
    is_passed: NDArray[np.bool_] = (fall >= 0) & (rise > 0) & (later | earlier)
    return is_passed


def _minima(value: Callable[[Array], Array], begin: Array, end: Array) -> tuple[Array, Array]:
    """Return the instants at which a value is least within intervals, and the least values."""
    t, least, rows = begin, np.full(len(begin), np.inf), np.arange(len(begin))
    for _ in range(ROUNDS if len(begin) else 0):
        times = _divided(begin, end, FINER)
        values = value(times.ravel()).reshape(times.shape)
        places = np.argmin(np.where(np.isfinite(values), values, np.inf), axis=1)
        t, least = times[rows, places], values[rows, places]
        begin, end = times[rows, np.maximum(places - 1, 0)], times[rows, np.minimum(places + 1, FINER)]
    return t, least


def _divided(begin: Array, end: Array, parts: int) -> Array:
    """Return instants that divide intervals evenly, including their ends, one row for each interval."""
    return begin[:, None] + (end - begin)[:, None] * np.linspace(0, 1, parts + 1)


def _finite(model: Model, parameters: Array, trail: Array) -> tuple[Array, Array, Array]:
    """Return instants, states and rates of the coordinates at the ends of steps where all of them are finite."""
    t, states = trail[:, 0], trail[:, 1 : 1 + len(model.state)]
    function = model.function(model.coordinate_rates, (*model.parameters, *model.damping))
    with np.errstate(all="ignore"):
        rates = np.asarray(function(t, *states.T, *parameters)).T
    is_finite = np.isfinite(t) & np.isfinite(states).all(axis=1) & np.isfinite(rates).all(axis=1)
    return t[is_finite], states[is_finite], rates[is_finite]


def _interpolation(t: Array, states: Array, rates: Array) -> Callable[[Array], Array]:
    """Return the states between steps: Hermite polynomials for the coordinates, the last values for the speeds."""
    from scipy.interpolate import CubicHermiteSpline  # noqa: PLC0415 - slow to load, and rarely needed

    q = rates.shape[1]
    coordinates = CubicHermiteSpline(t, states[:, :q], rates)

    def way(times: Array) -> Array:
        last = np.clip(np.searchsorted(t, times, side="right") - 1, 0, len(t) - 1)
        return np.hstack([coordinates(times), states[last, q:]])

    return way
