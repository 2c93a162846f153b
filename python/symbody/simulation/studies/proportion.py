"""A probability, estimated by the share of cases above a level."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from symbody.errors import ArgumentError
from symbody.simulation.given.real import is_real
from symbody.symbolic.given.arguments import described

__all__ = ["Proportion", "proportion_above"]

PLACE = "study.probability"


class Proportion(NamedTuple):
    """A probability, estimated by the share of cases.

    Attributes:
        value: the share.
        low: the lower end of its confidence interval.
        high: the upper end.
    """

    value: float
    low: float
    high: float


def proportion_above(
    values: NDArray[np.float64], measure: str, above: float, confidence: float
) -> Proportion:
    """Return the share of the known values that are above a level, with its confidence interval [Wilson 1927].

    Args:
        values: a measure of all cases, shape (k,); NaN where it is unknown.
        measure: its name, for messages.
        above: the level.
        confidence: the probability that the interval contains the true value.

    Raises:
        ArgumentError: no value is known, the level is no number, or the confidence is not between 0 and 1.
    """
    from scipy import stats  # noqa: PLC0415 - slow to load

    if not is_real(above):
        raise ArgumentError(f"{PLACE}: above={described(above)}; expected a number, the level of {measure!r}")
    if not is_real(confidence) or not 0 < confidence < 1:
        raise ArgumentError(
            f"{PLACE}: confidence={described(confidence)}; expected a probability between 0 and 1, such as 0.95"
        )
    known = values[np.isfinite(values)]
    if not known.size:
        raise ArgumentError(f"{PLACE}: no case has a value of {measure!r}")
    test = stats.binomtest(int(np.count_nonzero(known > above)), known.size)
    interval = test.proportion_ci(confidence, method="wilson")
    return Proportion(float(test.statistic), float(interval.low), float(interval.high))
