"""Samples have the distributions that were asked for, and are the same for the same seed."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from scipy import stats

from symbody import LazySample, ModelNotice, functions_of_time, sample, symbols
from symbody.errors import ArgumentError
from symbody.simulation.studies.sample.sequence import SEQUENCES

a, b, c = symbols("a b c")
q = functions_of_time("q")


@pytest.mark.parametrize("method", sorted(SEQUENCES))
@pytest.mark.parametrize(
    ("given", "expected"),
    [
        (("uniform", -1, 3), stats.uniform(-1, 4)),
        (("normal", 2, 0.5), stats.norm(2, 0.5)),
        (("lognormal", 2, 0.5), stats.lognorm(s=0.5, scale=2)),
        (stats.weibull_min(1.7, scale=3), stats.weibull_min(1.7, scale=3)),
        (stats.triang(0.2), stats.triang(0.2)),
    ],
)
def test_columns_have_their_distributions(method: str, given: Any, expected: Any) -> None:
    """By the test of Kolmogorov and Smirnov, which judges one random sample; others are more even."""
    table = sample({a: given, b: ("uniform", 0, 1)}, 512, method=method, seed=5)
    values = table[a][:512]
    assert stats.kstest(values, expected.cdf).pvalue > 0.01
    assert abs(np.corrcoef(values, table[b][:512])[0, 1]) < 0.12


@pytest.mark.parametrize("method", sorted(SEQUENCES))
def test_a_seed_decides_all_values(method: str) -> None:
    given: Any = {a: ("normal", 0, 1), q: [1.0, 2.0, 5.0]}
    one, same, other = (sample(given, 64, method=method, seed=seed) for seed in (3, 3, 4))
    for name in given:
        np.testing.assert_array_equal(one[name], same[name])
    assert (one[a] != other[a]).any()


def test_choices_have_their_shares() -> None:
    table = sample({a: [1.0, 2.0, 4.0, 8.0], b: {0.0: 3, 1.0: 1}, c: stats.poisson(3)}, 1024, seed=1)
    assert [np.mean(table[a] == value) for value in (1, 2, 4, 8)] == [0.25] * 4
    assert table[b].mean() == 0.25
    assert table[c].mean() == pytest.approx(3, abs=0.02)


@pytest.mark.parametrize(
    "covariance",
    [
        [[1.0, 0.6, 0.0], [0.6, 2.0, -0.3], [0.0, -0.3, 0.5]],
        [[1.0, 1.0, 0.0], [1.0, 1.0, 0.0], [0.0, 0.0, 0.5]],
    ],
)
def test_correlated_normals(covariance: Any) -> None:
    """Also where a combination of them is certain."""
    together = stats.multivariate_normal([1, 2, 3], covariance, allow_singular=True)
    table = sample({(a, b, q): together}, 4096, seed=2)
    rows = np.array([table[a], table[b], table[q]])
    np.testing.assert_allclose(np.cov(rows), covariance, atol=0.01)
    np.testing.assert_allclose(rows.mean(axis=1), [1, 2, 3], atol=1e-3)


def test_points_of_a_sobol_sequence_that_are_not_balanced_are_told() -> None:
    with pytest.warns(ModelNotice, match="1000 is no power of two"):
        table = sample({a: ("uniform", 0, 1)}, 1000)
    assert len(table[a]) == 1000


def test_a_table_of_saltelli_has_the_columns_of_a_and_b() -> None:
    table = sample({a: ("uniform", 0, 1), b: ("normal", 0, 1)}, 8, method="saltelli")
    A, B, AB_a, AB_b = np.array([table[a], table[b]]).reshape(2, 4, 8).swapaxes(0, 1)
    np.testing.assert_array_equal(AB_a, [B[0], A[1]])
    np.testing.assert_array_equal(AB_b, [A[0], B[1]])


def test_a_lazy_sample_names_what_it_has() -> None:
    table = LazySample({a: ("uniform", 0, 1)}, 8)
    with pytest.raises(ArgumentError, match=r"^LazySample: there is no variable b; expected one of a$"):
        table.column(b)
    for first, count in [(-1, 2), (7, 2), (0, 0)]:
        with pytest.raises(ArgumentError, match=rf"from case {first}; expected some of 0 to 7$"):
            table.block(first, count)
