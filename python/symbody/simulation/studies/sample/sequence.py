"""Sequences of points in the unit cube: pseudorandom and quasirandom ones."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Mapping

import numpy as np
from numpy.typing import NDArray

from symbody.errors import notify

__all__ = ["SEQUENCES", "Sequence"]

Array = NDArray[np.float64]

Sequence = Callable[[int, int, int], Array]
"""Points in the unit cube, shape (n, d), of the dimension d, the number n, and the seed."""


def monte_carlo(d: int, n: int, seed: int) -> Array:
    """Return independent points by NumPy's default generator; means have the error ``sigma / sqrt(n)``."""
    return np.random.default_rng(seed).random((n, d))


def latin_hypercube(d: int, n: int, seed: int) -> Array:
    """Return a Latin hypercube: each variable has one value in each of n equal intervals [McKay et al. 1979]."""
    from scipy.stats import qmc  # noqa: PLC0415 - slow to load

    return np.asarray(qmc.LatinHypercube(d, seed=seed).random(n))


def halton(d: int, n: int, seed: int) -> Array:
    """Return a scrambled Halton sequence: even in few dimensions, for any n [Owen 2017]."""
    from scipy.stats import qmc  # noqa: PLC0415

    return np.asarray(qmc.Halton(d, seed=seed).random(n))


def sobol(d: int, n: int, seed: int) -> Array:
    """Return a scrambled Sobol sequence, which is balanced if n is a power of two [Owen 1998]."""
    from scipy.stats import qmc  # noqa: PLC0415

    if n & (n - 1):
        lower = 1 << (n.bit_length() - 1)
        notify(
            f"sample: {n} points of a Sobol sequence are not balanced, as {n} is no power of two: means converge "
            f"more slowly; use {lower} or {2 * lower} points, or method='halton'"
        )
    with warnings.catch_warnings():
        warnings.filterwarnings("ignore", "The balance properties of Sobol")
        return np.asarray(qmc.Sobol(d, seed=seed).random(n))


def saltelli(d: int, n: int, seed: int) -> Array:
    """Return the points A, B, and AB_i, which is A with column i of B: n (d + 2) points [Saltelli et al. 2010]."""
    both = sobol(2 * d, n, seed)
    A, B = both[:, :d], both[:, d:]
    mixed = [np.where(np.arange(d) == i, B, A) for i in range(d)]
    return np.concatenate([A, B, *mixed])


SEQUENCES: Mapping[str, Sequence] = {
    "sobol": sobol,
    "latin_hypercube": latin_hypercube,
    "halton": halton,
    "monte_carlo": monte_carlo,
    "saltelli": saltelli,
}
"""The methods of `sample`."""
