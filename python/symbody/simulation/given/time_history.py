"""Time histories: inputs that are given as tables of instants and values, for all motions or for each its own."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike, NDArray

from symbody.errors import ParameterError
from symbody.symbolic import Expr, Max, number, symbols, t
from symbody.symbolic.given.arguments import described, with_known_names

__all__ = ["time_histories", "time_history"]

Array = NDArray[np.float64]


@with_known_names
def time_history(instants: ArrayLike, values: ArrayLike) -> Expr:
    """Return an input through given values at given instants, with straight lines between them.

    It is constant before the first instant and after the last one: ``v0 + sum of (s_i - s_(i-1)) Max(t - t_i, 0)``,
    with the slopes ``s_i`` between neighbouring instants. The integrator does not stop at the bends: a `max_step` as
    long as the intervals makes it see all of them.

    Args:
        instants: the instants in increasing order, shape (N,), in s.
        values: the values there, shape (N,).

    Raises:
        ParameterError: the numbers are no such table.

    >>> from symbody import t, time_history
    >>> force = time_history([0, 1, 3], [0, 2, 1])
    >>> [float(force.evaluate({t: instant})) for instant in (-1, 0.5, 2, 9)]
    [0.0, 1.0, 1.5, 1.0]
    """
    places = _instants(instants, "time_history")
    heights = _numbers(values, "time_history: values")
    if heights.shape != places.shape:
        raise ParameterError(
            f"time_history: values of shape {heights.shape}, and {len(places)} instants; expected one value for each"
        )
    return _polygon(places, [number(float(height)) for height in heights])


@with_known_names
def time_histories(name: str, instants: ArrayLike, rows: ArrayLike) -> tuple[Expr, dict[Expr, Array]]:
    """Return one input for many motions, each with values of its own at the same instants, and these values as cases.

    The values are parameters ``name0, name1, ...`` of the input, whose columns are `cases` of `simulate_many` and
    `study`; add those of other parameters by ``{**cases, ...}``. See `time_history` for what is between the instants.

    Args:
        name: what the names of the parameters begin with.
        instants: the instants in increasing order, shape (N,), in s.
        rows: the values there, a row for each of k motions, shape (k, N).

    Raises:
        ParameterError: the numbers are no such table.

    >>> from symbody import time_histories
    >>> force, cases = time_histories("F", [0, 1, 3], [[0, 2, 1], [0, -1, 0]])
    >>> cases
    {F0: array([0., 0.]), F1: array([ 2., -1.]), F2: array([1., 0.])}
    """
    places = _instants(instants, "time_histories")
    table = _numbers(rows, "time_histories: rows")
    if table.ndim != 2 or table.shape[1] != len(places) or not len(table):
        raise ParameterError(
            f"time_histories: rows of shape {table.shape}, and {len(places)} instants; expected a row for each motion, "
            f"of shape (k, {len(places)})"
        )
    heights = symbols(f"{name}0:{len(places)}")
    return _polygon(places, heights), dict(zip(heights, table.T.copy(), strict=True))


def _polygon(places: Array, heights: Sequence[Expr]) -> Expr:
    """Return the sum of the bends, each of which begins at an instant."""
    zero, rises = number(0), [after - before for before, after in pairwise(heights)]
    slopes = [rise / float(span) for rise, span in zip(rises, np.diff(places), strict=True)]
    bends = zip(pairwise([zero, *slopes, zero]), places, strict=True)
    terms = [(after - before) * Max(t - float(place), 0) for (before, after), place in bends]
    return sum(terms, start=heights[0])


def _instants(instants: ArrayLike, where: str) -> Array:
    places = _numbers(instants, f"{where}: instants")
    if places.ndim != 1 or len(places) < 2 or not (np.diff(places) > 0).all():
        raise ParameterError(f"{where}: instants {places.tolist()}; expected two or more in increasing order")
    return places


def _numbers(values: ArrayLike, place: str) -> Array:
    try:
        found = np.asarray(values, dtype=np.float64)
    except (TypeError, ValueError):
        raise ParameterError(f"{place}: {described(values)}; expected numbers") from None
    if not np.isfinite(found).all():
        raise ParameterError(
            f"{place}: {found[~np.isfinite(found)][0]} is among them; expected finite numbers"
        )
    return found
