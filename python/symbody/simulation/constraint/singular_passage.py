"""Singular positions that a motion passes: where its constraints become dependent between two steps."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np
from numpy.typing import NDArray

from symbody.simulation.model.model import Model
from symbody.symbolic import Expr

from .constraint_directions import masses_and_slopes

__all__ = ["singular_passages"]

Array = NDArray[np.float64]

SINGULAR, REGULAR = 0.01, 0.03
"""The parts of its largest value along the motion below which the least singular value is taken for zero, and above
which it is not."""
PARTS, MARGIN = 2, 2.0
"""Parts into which steps are cut to find out where the least singular value may vanish, and how many intervals away the
straight line through two values may meet zero where one interval was expected."""
ROUNDS, FINER = 2, 16
"""How often the intervals beside a minimum are cut again, and into how many parts."""
SHORT = 1e-9
"""The part of the time below which steps aren't told apart."""
AT_ONCE = 2**14
"""Matrices that are looked at at once: more would take much memory."""


def singular_passages(model: Model, parameters: Mapping[Expr, float], trail: Array) -> Array:
    """Return the instants, in s, at which the constraints of a motion are dependent, or as good as that.

    There the smallest singular value of ``phi_q L^-T``, with ``M = L L^T``, has a minimum next to zero; each constraint
    counts in units of its longest derivative along the motion. Between steps the coordinates are interpolated by cubic
    polynomials through their values and rates. A motion that stays at such positions for a while passes once.

    Args:
        model: what moves.
        parameters: the values of its parameters, and those of the stabilisation, if there is one.
        trail: the motion: rows of the instant, coordinates and speeds at the ends of its steps.
    """
    if not model.constraints or not model.independent_constraints:
        return np.empty(0)
    trail = _thinned(trail)
    if len(trail) < 2:
        return np.empty(0)
    p = np.array([parameters[name] for name in (*model.parameters, *model.damping)])
    way, ends = _way(model, p, trail), trail[:, 0]
    t = np.append(_cut(ends[:-1], ends[1:], PARTS)[:, :-1], ends[-1])

    def products(times: Array) -> Array:
        parts = np.array_split(times, 1 + len(times) // AT_ONCE)
        return np.concatenate([_products(model, p, part, way(part)) for part in parts])

    first = products(t)
    longest = np.sqrt(np.nanmax(np.einsum("kii->ki", first), axis=0, initial=0.0))
    scale = np.where(longest > 0, longest, 1.0)
    found = _smallest(first / np.multiply.outer(scale, scale), model.independent_constraints)
    largest = np.nanmax(found, initial=0.0)
    if largest == 0:
        return np.empty(0)

    def ratio(times: Array) -> Array:
        of_scale = products(times) / np.multiply.outer(scale, scale)
        return _smallest(of_scale, model.independent_constraints) / largest

    found = found / largest
    places = 1 + np.flatnonzero(_may_vanish(t, found) | (found[1:-1] < SINGULAR))
    at, least = _minima(ratio, t[places - 1], t[places + 1])
    is_passed = least < SINGULAR
    # Minima with nothing regular between them are of one passage: a motion may stay there.
    regular = np.searchsorted(t[found > REGULAR], at[is_passed])
    return at[is_passed][np.unique(regular, return_index=True)[1]]


def _thinned(trail: Array) -> Array:
    """Return the ends of steps in their order, one of those in each of `SHORT` equal parts of the time.

    Where a method finds no way on, thousands of its steps lie at one instant.
    """
    t = trail[:, 0]
    begin, span = t.min(initial=np.inf), np.ptp(t) if len(t) else 0.0
    kept: Array = trail[np.unique(np.floor((t - begin) / (SHORT * span or 1.0)), return_index=True)[1]]
    return kept


def _may_vanish(t: Array, ratio: Array) -> NDArray[np.bool_]:
    """Return whether a ratio may vanish next to its minima, for each instant but the first and the last.

    It falls and rises in proportion to the distance from where it vanishes: in the interval on one side, if the line
    through the values on the other side meets zero there.
    """
    h, change = np.diff(t), np.diff(ratio)
    here, fall, rise = ratio[1:-1], -change[:-1], change[1:]
    later, earlier = here * h[:-1] <= MARGIN * fall * h[1:], here * h[1:] <= MARGIN * rise * h[:-1]
    # Compared with NaN nothing is least.
    is_passed: NDArray[np.bool_] = (fall >= 0) & (rise > 0) & (later | earlier)
    return is_passed


def _minima(ratio: Callable[[Array], Array], begin: Array, end: Array) -> tuple[Array, Array]:
    """Return where the ratio is least within intervals, and how small it is there."""
    t, least, rows = begin, np.full(len(begin), np.inf), np.arange(len(begin))
    for _ in range(ROUNDS if len(begin) else 0):
        times = _cut(begin, end, FINER)
        values = ratio(times.ravel()).reshape(times.shape)
        places = np.argmin(np.where(np.isfinite(values), values, np.inf), axis=1)
        t, least = times[rows, places], values[rows, places]
        begin, end = times[rows, np.maximum(places - 1, 0)], times[rows, np.minimum(places + 1, FINER)]
    return t, least


def _cut(begin: Array, end: Array, parts: int) -> Array:
    """Return instants that part intervals evenly, their ends included, a row for each."""
    return begin[:, None] + (end - begin)[:, None] * np.linspace(0, 1, parts + 1)


def _way(model: Model, parameters: Array, trail: Array) -> Callable[[Array], Array]:
    """Return the states between the ends of steps: coordinates by Hermite's polynomials, speeds as they were last."""
    from scipy.interpolate import CubicHermiteSpline  # noqa: PLC0415 - slow to load, and few motions are looked at

    t, states, q = trail[:, 0], trail[:, 1 : 1 + len(model.state)], len(model.coordinates)
    function = model.function(model.kinematics, (*model.parameters, *model.damping))
    with np.errstate(all="ignore"):
        rates = np.asarray(function(t, *states.T, *parameters)).T
    coordinates = CubicHermiteSpline(t, states[:, :q], rates)

    def way(times: Array) -> Array:
        last = np.clip(np.searchsorted(t, times, side="right") - 1, 0, len(t) - 1)
        return np.hstack([coordinates(times), states[last, q:]])

    return way


def _products(model: Model, parameters: Array, t: Array, states: Array) -> Array:
    """Return ``phi_q M^-1 phi_q^T``, a matrix for each instant; NaN where it isn't finite."""
    M, J = masses_and_slopes(model, parameters, t, states)
    is_finite = np.isfinite(M).all(axis=(1, 2)) & np.isfinite(J).all(axis=(1, 2))
    is_fit = is_finite & (np.linalg.eigvalsh(np.where(np.isfinite(M), M, 0.0))[:, 0] > 0)
    products = np.full((len(t), J.shape[1], J.shape[1]), np.nan)
    products[is_fit] = J[is_fit] @ np.linalg.solve(M[is_fit], np.swapaxes(J[is_fit], 1, 2))
    return products


def _smallest(products: Array, rank: int) -> Array:
    """Return the smallest singular value of the independent constraints, NaN if not finite."""
    is_fit = np.isfinite(products).all(axis=(1, 2))
    smallest = np.full(len(products), np.nan)
    squares = np.linalg.eigvalsh(products[is_fit])
    smallest[is_fit] = np.sqrt(np.maximum(squares[:, -rank], 0.0))
    return smallest
