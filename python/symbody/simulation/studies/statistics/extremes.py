"""The smallest and the largest value, and the cases that have them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import final

import numpy as np

from .statistic import Array, Partial, Statistic

__all__ = ["extremes"]


@final
class Extremes(Statistic):
    """The extreme values and their cases; of several cases, the first one."""

    def of(self, values: Array, first: int) -> Partial:
        low, high = np.where(np.isnan(values), np.inf, values), np.where(np.isnan(values), -np.inf, values)
        return {
            "low": low.min(axis=0),
            "low case": low.argmin(axis=0) + first,
            "high": high.max(axis=0),
            "high case": high.argmax(axis=0) + first,
        }

    def merged(self, one: Partial, other: Partial) -> Partial:
        lower, higher = other["low"] < one["low"], other["high"] > one["high"]
        merged = {}
        for name, replaces in (("low", lower), ("high", higher)):
            for key in (name, f"{name} case"):
                merged[key] = np.where(replaces, other[key], one[key])
        return merged

    def columns(self, partial: Partial, names: Sequence[str]) -> dict[str, Array]:
        is_known = np.isfinite(partial["low"])
        pairs = {
            "minimum": "low",
            "minimum case": "low case",
            "maximum": "high",
            "maximum case": "high case",
        }
        return {name: np.where(is_known, partial[key], np.nan) for name, key in pairs.items()}


def extremes() -> Statistic:
    """Return the statistic of the smallest and the largest value, and the case that has it.

    >>> from symbody import statistics
    >>> statistics.extremes()
    Extremes()
    """
    return Extremes()
