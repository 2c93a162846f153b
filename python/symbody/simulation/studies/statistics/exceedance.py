"""The probability of exceeding a level."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import final

import numpy as np

from symbody.errors import ArgumentError
from symbody.simulation.given.real import is_real
from symbody.symbolic.given.arguments import described

from .statistic import Array, Partial, Statistic

__all__ = ["exceedance"]


@final
@dataclass(frozen=True)
class Exceedance(Statistic):
    """How many values there are, and how many are above the level.

    Attributes:
        level: the level.
    """

    level: float

    def of(self, values: Array, first: int) -> Partial:
        return {"n": (~np.isnan(values)).sum(axis=0), "above": (values > self.level).sum(axis=0)}

    def merged(self, one: Partial, other: Partial) -> Partial:
        return {key: one[key] + other[key] for key in ("n", "above")}

    def columns(self, partial: Partial, names: Sequence[str]) -> dict[str, Array]:
        with np.errstate(invalid="ignore", divide="ignore"):
            return {f"probability above {self.level:g}": partial["above"] / partial["n"]}


def exceedance(level: float) -> Statistic:
    """Return the statistic of the probability that an output is above a level at an instant.

    For the time above a level in each motion, use `measures.time_above`.

    >>> from symbody import statistics
    >>> statistics.exceedance(0.5)
    Exceedance(level=0.5)
    """
    if not is_real(level):
        raise ArgumentError(f"statistics.exceedance: level={described(level)}; expected a number")
    return Exceedance(float(level))
