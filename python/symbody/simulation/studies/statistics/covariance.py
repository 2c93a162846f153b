"""Covariances between outputs at the same instant."""

from __future__ import annotations

from collections.abc import Sequence
from typing import final

import numpy as np

from .statistic import Array, Partial, Statistic

__all__ = ["covariance"]


@final
class Covariance(Statistic):
    """The means and the sums of products of deviations C of all pairs of outputs, over cases that have them all."""

    def of(self, values: Array, first: int) -> Partial:
        is_known = np.asarray(~np.isnan(values).any(axis=1))
        n = is_known.sum(axis=0)
        kept = np.where(is_known[:, np.newaxis], values, 0.0)
        mean = kept.sum(axis=0) / np.maximum(n, 1)
        apart = np.where(is_known[:, np.newaxis], values - mean, 0.0)
        return {"n": n, "mean": mean, "C": np.einsum("kin,kjn->ijn", apart, apart, optimize=False)}

    def merged(self, one: Partial, other: Partial) -> Partial:
        """Merge by ``C = C_a + C_b + d d^T n_a n_b / n`` with d the difference of the means."""
        n = one["n"] + other["n"]
        share = other["n"] / np.maximum(n, 1)
        d = other["mean"] - one["mean"]
        C = one["C"] + other["C"] + d[:, np.newaxis] * d * (one["n"] * share)
        return {"n": n, "mean": one["mean"] + d * share, "C": C}

    def columns(self, partial: Partial, names: Sequence[str]) -> dict[str, Array]:
        n = partial["n"]
        with np.errstate(invalid="ignore", divide="ignore"):
            C = np.where(n > 1, partial["C"] / (n - 1), np.nan)
        return {f"covariance with {name}": C[:, k] for k, name in enumerate(names)}


def covariance() -> Statistic:
    """Return the statistic of the covariances of each output with all others, ``C / (n - 1)``, at the same instant.

    >>> from symbody import statistics
    >>> statistics.covariance()
    Covariance()
    """
    return Covariance()
