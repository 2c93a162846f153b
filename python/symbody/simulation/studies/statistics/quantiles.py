"""Quantiles, exact for few cases, and by t-digests for many."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial as partial_of
from typing import Any, ClassVar, final

import numpy as np
from numpy.typing import NDArray

from symbody.errors import ArgumentError
from symbody.simulation.given.extra import loaded
from symbody.simulation.given.real import is_real
from symbody.symbolic.given.arguments import described

from .statistic import Array, Partial, Statistic

__all__ = ["quantiles"]

EXACT = 1000
"""The number of cases up to which all values are kept, and quantiles are exact."""

_CENTROIDS = 200
"""The most centroids of a t-digest, of 16 bytes each: the error of the rank is below 0.5 %, and less at the ends."""


@final
@dataclass(frozen=True)
class Quantiles(Statistic):
    """Up to `EXACT` cases the values themselves; beyond, a t-digest for each output and instant [Dunning 2021].

    Attributes:
        probabilities: the probabilities of the quantiles.
    """

    numbers: ClassVar[int] = 2 * _CENTROIDS
    probabilities: tuple[float, ...]

    def of(self, values: Array, first: int) -> Partial:
        return {"values": values} if len(values) <= EXACT else _digested({"values": values})

    def merged(self, one: Partial, other: Partial) -> Partial:
        if "values" in one and "values" in other:
            both = np.concatenate([one["values"], other["values"]])
            return {"values": both} if len(both) <= EXACT else _digested({"values": both})
        digests, others = _digests(_digested(one)["digests"]), _digests(_digested(other)["digests"])
        pairs = zip(digests, others, strict=True)
        return _packed([digest.merge(more) for digest, more in pairs], _shape(one))

    def columns(self, partial: Partial, names: Sequence[str]) -> dict[str, Array]:
        if "values" in partial:
            rows = _exact(partial["values"], self.probabilities)
        else:
            found = [_quantiles_of(digest, self.probabilities) for digest in _digests(partial["digests"])]
            rows = np.array(found).T.reshape(-1, *_shape(partial))
        return {f"quantile {p:g}": row for p, row in zip(self.probabilities, rows, strict=True)}


def _exact(values: Array, probabilities: Sequence[float]) -> Array:
    """Return quantiles of the known values, shape (probabilities, q, N); NaN where there are none."""
    flat = values.reshape(len(values), -1)
    rows = np.full((len(probabilities), flat.shape[1]), np.nan)
    is_known = ~np.isnan(flat)
    for place in np.flatnonzero(is_known.any(axis=0)):
        rows[:, place] = np.quantile(flat[is_known[:, place], place], probabilities)
    return rows.reshape(len(probabilities), *values.shape[1:])


def _digested(partial: Partial) -> Partial:
    """Return a partial result as t-digests."""
    if "digests" in partial:
        return partial
    values = partial["values"]
    make = partial_of(_library().from_values, max_centroids=_CENTROIDS)
    columns = values.reshape(len(values), -1).T
    return _packed([make(column[~np.isnan(column)]) for column in columns], values.shape[1:])


def _shape(partial: Partial) -> tuple[int, ...]:
    """Return the number of outputs, and that of instants."""
    return tuple(partial["shape"]) if "shape" in partial else partial["values"].shape[1:]


def _packed(digests: Sequence[Any], shape: tuple[int, ...]) -> Partial:
    """Return t-digests as one array of bytes: their lengths, then the bytes of all of them."""
    texts = [digest.to_bytes() for digest in digests]
    lengths = np.array([len(texts), *map(len, texts)], dtype="<i8").tobytes()
    return {
        "digests": np.frombuffer(lengths + b"".join(texts), dtype=np.uint8),
        "shape": np.array(shape, dtype=np.int64),
    }


def _digests(packed: NDArray[np.uint8]) -> list[Any]:
    data = packed.tobytes()
    count = int(np.frombuffer(data, "<i8", 1)[0])
    lengths = np.frombuffer(data, "<i8", count, offset=8)
    ends = 8 * (count + 1) + np.cumsum(lengths)
    read = _library().from_bytes
    return [read(data[end - length : end]) for end, length in zip(ends, lengths, strict=True)]


def _quantiles_of(digest: Any, probabilities: Sequence[float]) -> list[float]:
    if digest.is_empty():
        return [np.nan] * len(probabilities)
    return [float(digest.quantile(p)) for p in probabilities]


def _library() -> Any:
    """Return the class of t-digests."""
    purpose = f"statistics.quantiles: of more than {EXACT} cases, quantiles need it; or leave quantiles out"
    return loaded("fastdigest", purpose).TDigest


def quantiles(*probabilities: float) -> Statistic:
    """Return the statistic of quantiles, such as the median and a band of 90 %.

    They are exact up to 1000 cases. Of more, t-digests keep 200 centroids for each instant; the error of the rank
    is below 0.5 %, and less towards the ends and with more cases.

    Args:
        probabilities: between 0 and 1.

    Raises:
        ArgumentError: there are none, or one is no probability.

    >>> from symbody import statistics
    >>> statistics.quantiles(0.05, 0.5, 0.95)
    Quantiles(probabilities=(0.05, 0.5, 0.95))
    """
    if not probabilities or not all(is_real(p) and 0 <= p <= 1 for p in probabilities):
        raise ArgumentError(
            f"statistics.quantiles: {described(probabilities)}; expected probabilities between 0 and 1, such as "
            "quantiles(0.05, 0.5, 0.95)"
        )
    return Quantiles(tuple(float(p) for p in probabilities))
