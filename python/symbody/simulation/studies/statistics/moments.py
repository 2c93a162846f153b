"""Mean and variance."""

from __future__ import annotations

from collections.abc import Sequence
from typing import final

import numpy as np

from .statistic import Array, Partial, Statistic

__all__ = ["moments"]


@final
class Moments(Statistic):
    """The number of values n, their mean, and the sum of squared deviations M2."""

    def of(self, values: Array, first: int) -> Partial:
        is_known = ~np.isnan(values)
        n = is_known.sum(axis=0)
        with np.errstate(invalid="ignore", divide="ignore"):
            mean = np.where(is_known, values, 0.0).sum(axis=0) / n
        mean = np.where(n > 0, mean, 0.0)
        return {"n": n, "mean": mean, "M2": np.where(is_known, (values - mean) ** 2, 0.0).sum(axis=0)}

    def merged(self, one: Partial, other: Partial) -> Partial:
        """Merge by ``M2 = M2_a + M2_b + d^2 n_a n_b / n`` with d the difference of the means [Chan et al. 1983]."""
        n = one["n"] + other["n"]
        share = other["n"] / np.maximum(n, 1)
        d = other["mean"] - one["mean"]
        M2 = one["M2"] + other["M2"] + d**2 * one["n"] * share
        return {"n": n, "mean": one["mean"] + d * share, "M2": M2}

    def columns(self, partial: Partial, names: Sequence[str]) -> dict[str, Array]:
        n = partial["n"]
        with np.errstate(invalid="ignore", divide="ignore"):
            variance = np.where(n > 1, partial["M2"] / (n - 1), np.nan)
        mean = np.where(n > 0, partial["mean"], np.nan)
        return {
            "count": n.astype(np.float64),
            "mean": mean,
            "variance": variance,
            "standard deviation": np.sqrt(variance),
        }


def moments() -> Statistic:
    """Return the statistic of the count, the mean, the variance ``M2 / (n - 1)``, and the standard deviation.

    >>> from symbody import statistics
    >>> statistics.moments()
    Moments()
    """
    return Moments()
