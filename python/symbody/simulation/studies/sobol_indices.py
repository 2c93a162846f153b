"""Sobol indices: how the variance of a result is divided among the variables."""

from __future__ import annotations

import os
import warnings
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from symbody.errors import ArgumentError, ParameterError
from symbody.simulation.motion.drawing import drawing_function
from symbody.symbolic import Expr
from symbody.symbolic.expression.html_table import html_table
from symbody.symbolic.given.arguments import described, with_known_names

if TYPE_CHECKING:
    from matplotlib.figure import Figure

__all__ = ["SobolIndices", "sobol_indices"]

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class SobolIndices:
    """The shares of the variance of a result that d variables explain [Sobol 2001].

    Of results over time, of shape (k, N), the indices have the shape (d, N), and there are no confidence intervals.

    Attributes:
        names: the variables.
        first: S_i = Var(E(y | x_i)) / Var(y), what a variable explains alone, shape (d,).
        total: T_i = E(Var(y | all but x_i)) / Var(y), what it explains with all others, shape (d,).
        first_interval: the confidence intervals of the first, shape (d, 2).
        total_interval: those of the others, shape (d, 2).
        confidence: the probability of these intervals.

    >>> from symbody import sample, sobol_indices, symbols
    >>> a, b = symbols("a b")
    >>> table = sample({a: ("uniform", 0, 1), b: ("uniform", 0, 1)}, 64, method="saltelli")
    >>> found = sobol_indices(table, table[a])
    >>> found.names, found.first.round(2) + 0.0
    ((a, b), array([1., 0.]))
    """

    names: tuple[Expr, ...]
    first: Array = field(repr=False)
    total: Array = field(repr=False)
    first_interval: Array = field(repr=False)
    total_interval: Array = field(repr=False)
    confidence: float = 0.95

    def _rows(self) -> list[list[str]]:
        rows = []
        for k, name in enumerate(self.names):
            pairs = ((self.first, self.first_interval), (self.total, self.total_interval))
            texts = [
                text
                for values, interval in pairs
                for text in (f"{values[k]:.4f}", f"{interval[k, 0]:.4f} to {interval[k, 1]:.4f}")
            ]
            rows.append([str(name), *texts])
        return rows

    def _repr_html_(self) -> str:
        if self.first.ndim > 1:
            return html_table(repr(self), ["variable"], [[str(name)] for name in self.names])
        range_of = f"{100 * self.confidence:g} %"
        header = ["variable", "first order", range_of, "total", range_of]
        return html_table("Sobol indices", header, self._rows())

    @with_known_names
    def plot(self, *, title: str = "", path: str | os.PathLike[str] | None = None) -> Figure:
        """Return a figure of the indices, with their confidence intervals.

        Args:
            title: the title.
            path: a file to write as well.

        Raises:
            ArgumentError: the indices are those of a result over time.
            PictureError: the file can't be written.
        """
        if self.first.ndim > 1:
            raise ArgumentError(
                "SobolIndices.plot: these are indices over time, of shape (d, N); plot .first and .total over the "
                "instants"
            )
        figure: Figure = drawing_function("plot_sobol_indices")(
            [*map(str, self.names)],
            self.first,
            self.total,
            self.first_interval,
            self.total_interval,
            title=title,
            path=path,
        )
        return figure


@with_known_names
def sobol_indices(
    table: Mapping[Expr, ArrayLike],
    values: ArrayLike,
    *,
    confidence: float = 0.95,
    resamples: int = 999,
    seed: int = 0,
) -> SobolIndices:
    """Return the Sobol indices of a result, by the estimators of Saltelli et al. [2010] in SciPy.

    Confidence intervals are those of the bootstrap.

    Args:
        table: the ``sample(..., method="saltelli")`` whose cases were run.
        values: the result of each case, such as ``study["peak"]``, shape (k,); or over time, shape (k, N).
        confidence: the probability of the confidence intervals.
        resamples: the number of resamples of the bootstrap.
        seed: its seed.

    Raises:
        ParameterError: the table is another sample, or there is not one finite value for each case.
        ArgumentError: an argument has the wrong kind.

    >>> from symbody import sample, sobol_indices, symbols
    >>> a, b = symbols("a b")
    >>> table = sample({a: ("uniform", 0, 1), b: ("uniform", 0, 1)}, 1024, method="saltelli")
    >>> found = sobol_indices(table, table[a] + 2 * table[b])
    >>> found.first.round(2), found.total.round(2)
    (array([0.2, 0.8]), array([0.2, 0.8]))
    """
    from scipy import stats  # noqa: PLC0415 - slow to load

    columns = _columns(table)
    A, B, AB = _blocks(columns, _results(values, columns.shape[1]))
    d, n = len(columns), A.shape[1]
    spread = np.ptp(np.concatenate([A, B], axis=1), axis=1)
    if not (spread > 0).any():
        raise ParameterError("sobol_indices: the result is the same in all cases; its variance is zero")
    with warnings.catch_warnings(), np.errstate(invalid="ignore", divide="ignore"):
        warnings.simplefilter("ignore")  # of instants at which the result doesn't vary: their indices are NaN
        found = stats.sobol_indices(func={"f_A": A, "f_B": B, "f_AB": AB}, n=n)
    first, total = (np.reshape(each, (-1, d)) for each in (found.first_order, found.total_order))
    first[spread == 0] = total[spread == 0] = np.nan
    if A.shape[0] > 1:
        none = np.full((d, 2), np.nan)
        return SobolIndices(tuple(table), first.T, total.T, none, none, confidence)
    spans = _intervals(A[0], B[0], AB[:, 0], confidence, resamples, seed)
    return SobolIndices(tuple(table), first.ravel(), total.ravel(), *spans, confidence)


def _columns(table: object) -> Array:
    """Return the columns of a table, shape (d, k), if it is one of method="saltelli"."""
    if not isinstance(table, Mapping) or not table:
        raise ArgumentError(
            f"sobol_indices, table: {described(table)}; expected a sample(..., method='saltelli')"
        )
    columns = np.array([np.asarray(column, dtype=np.float64) for column in table.values()])
    d, k = len(columns), columns.shape[1] if columns.ndim == 2 else 0
    n = k // (d + 2)
    blocks = columns.reshape(d, d + 2, n) if k == n * (d + 2) and n else None
    if blocks is None or not all(
        np.array_equal(blocks[i, 2 + j], blocks[i, 1 if i == j else 0]) for i in range(d) for j in range(d)
    ):
        raise ParameterError(
            "sobol_indices: the table is not made for them; expected sample(..., method='saltelli'), with all cases "
            "in order"
        )
    return columns


def _results(values: ArrayLike, cases: int) -> Array:
    """Return the results, shape (k, N)."""
    array = np.asarray(values, dtype=np.float64)
    if array.ndim not in {1, 2} or len(array) != cases:
        raise ParameterError(
            f"sobol_indices: values of shape {array.shape} for {cases} cases; expected one for each case"
        )
    rows = array.reshape(cases, -1)
    unknown = np.flatnonzero(~np.isfinite(rows).all(axis=1))
    if unknown.size:
        raise ParameterError(
            f"sobol_indices: {unknown.size} of {cases} cases have no finite value, the first is case {unknown[0]}; "
            "every case counts: choose distributions for which no motion fails, or a result that each motion has"
        )
    return rows


def _blocks(columns: Array, rows: Array) -> tuple[Array, Array, Array]:
    """Return the results at A and B, shape (N, n), and at AB_i, shape (d, N, n)."""
    d, cases = columns.shape
    blocks = np.moveaxis(rows.reshape(d + 2, cases // (d + 2), -1), 2, 1)
    return blocks[0], blocks[1], blocks[2:]


def _intervals(
    A: Array, B: Array, AB: Array, confidence: float, resamples: int, seed: int
) -> tuple[Array, Array]:
    """Return confidence intervals of first-order and total indices, shape (d, 2) each, by the percentile bootstrap.

    SciPy's own are those of BCa, whose jackknife takes memory for n^2 numbers.

    Args:
        A: the results at A, shape (n,).
        B: those at B.
        AB: those at AB_i, shape (d, n).
        confidence: the probability of the intervals.
        resamples: the number of resamples.
        seed: the seed of the generator.
    """
    generator, n = np.random.default_rng(seed), len(A)
    first, total = np.empty((resamples, len(AB))), np.empty((resamples, len(AB)))
    for row in range(resamples):
        chosen = generator.integers(n, size=n)
        a, b, ab = A[chosen], B[chosen], AB[:, chosen]
        mean, variance = np.mean([a, b]), np.var([a, b])
        with np.errstate(invalid="ignore", divide="ignore"):
            first[row] = ((b - mean) * (ab - a)).mean(axis=1) / variance
            total[row] = ((a - ab) ** 2).mean(axis=1) / (2 * variance)
    ends = (0.5 - confidence / 2, 0.5 + confidence / 2)
    return np.quantile(first, ends, axis=0).T, np.quantile(total, ends, axis=0).T
