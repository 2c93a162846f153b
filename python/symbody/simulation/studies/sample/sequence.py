"""Sequences of points in the unit cube, pseudorandom and quasirandom ones, of which any part can be computed."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from symbody.errors import notify

__all__ = ["SEQUENCES", "Points", "Sequence"]

Array = NDArray[np.float64]

Points = Callable[[int, int], Array]
"""Points of a sequence, shape (count, d): the number of the first one, and how many."""

Sequence = Callable[[int, int, int], Points]
"""A sequence in the unit cube, of the dimension d, the number n of points, and the seed."""


def monte_carlo(d: int, n: int, seed: int) -> Points:
    """Return independent points by NumPy's default generator; means have the error ``sigma / sqrt(n)``."""

    def points(first: int, count: int) -> Array:
        bits = np.random.PCG64(seed)
        bits.advance(first * d)
        return np.random.Generator(bits).random((count, d))

    return points


def latin_hypercube(d: int, n: int, seed: int) -> Points:
    """Return a Latin hypercube: each variable has one value in each of n equal intervals [McKay et al. 1979].

    The intervals of all points are permuted together, so the whole cube is kept, 8 d bytes a point.
    """
    from scipy.stats import qmc  # noqa: PLC0415 - slow to load

    whole = np.asarray(qmc.LatinHypercube(d, seed=seed).random(n))
    return lambda first, count: whole[first : first + count]


def halton(d: int, n: int, seed: int) -> Points:
    """Return a scrambled Halton sequence: even in few dimensions, for any n [Owen 2017]."""
    from scipy.stats import qmc  # noqa: PLC0415

    return _parts_of(qmc.Halton(d, seed=seed))


def sobol(d: int, n: int, seed: int) -> Points:
    """Return a scrambled Sobol sequence, which is balanced if n is a power of two [Owen 1998]."""
    from scipy.stats import qmc  # noqa: PLC0415

    if n & (n - 1):
        lower = 1 << (n.bit_length() - 1)
        notify(
            f"sample: {n} points of a Sobol sequence are not balanced, as {n} is no power of two: means converge "
            f"more slowly; use {lower} or {2 * lower} points, or method='halton'"
        )
    return _parts_of(qmc.Sobol(d, seed=seed))


def _parts_of(engine: Any) -> Points:
    """Return the points of a generator of SciPy; parts that follow each other need no search for their beginning."""

    def points(first: int, count: int) -> Array:
        if engine.num_generated != first:
            engine.reset()
            if first:
                engine.fast_forward(first)
        with warnings.catch_warnings():
            warnings.filterwarnings("ignore", "The balance properties of Sobol")
            return np.asarray(engine.random(count))

    return points


def saltelli(d: int, n: int, seed: int) -> Points:
    """Return the points A, B, and AB_i, which is A with column i of B: n (d + 2) points [Saltelli et al. 2010]."""
    both = sobol(2 * d, n, seed)

    def points(first: int, count: int) -> Array:
        sections = range(first // n, -(-(first + count) // n))
        bounds = [(max(first, s * n), min(first + count, (s + 1) * n)) for s in sections]
        return np.concatenate(
            [section(s, begin - s * n, end - begin) for s, (begin, end) in zip(sections, bounds, strict=True)]
        )

    def section(number: int, first: int, count: int) -> Array:
        part = both(first, count)
        A, B = part[:, :d], part[:, d:]
        return (A, B)[number] if number < 2 else np.where(np.arange(d) == number - 2, B, A)

    return points


SEQUENCES: Mapping[str, Sequence] = {
    "sobol": sobol,
    "latin_hypercube": latin_hypercube,
    "halton": halton,
    "monte_carlo": monte_carlo,
    "saltelli": saltelli,
}
"""The methods of `sample`."""
