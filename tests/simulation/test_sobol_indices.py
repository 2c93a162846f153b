"""Sobol indices: published values, SciPy's own analysis, and results over time."""

from __future__ import annotations

import numpy as np
import pytest
from scipy import stats

from symbody import (
    Body,
    Expr,
    System,
    functions_of_time,
    measures,
    newton_euler,
    sample,
    sin,
    sobol_indices,
    study,
    symbols,
    translate,
)
from symbody.errors import ArgumentError
from tests.simulation.oscillator import c, displacement, k, oscillators, x

a, b = 7.0, 0.1


def ishigami(p: tuple[Expr, ...]) -> Expr:
    """The function of Ishigami & Homma [1990]."""
    return sin(p[0]) + a * sin(p[1]) ** 2 + b * p[2] ** 4 * sin(p[0])


def test_the_function_of_ishigami() -> None:
    """Its values are integrated over a second; the indices are published in closed form [Sobol & Levitan 1999]."""
    y, p = functions_of_time("y"), symbols("p1 p2 p3")
    still = newton_euler(System([Body(translate(y, 0, 0), 1)], coordinates=[y]))
    table = sample(dict.fromkeys(p, ("uniform", -np.pi, np.pi)), 512, method="saltelli", seed=2)
    values = study(still, t=(0, 1), cases=table, measures={"f": measures.integral(ishigami(p))})["f"]
    found = sobol_indices(table, values, resamples=300)
    variance = a**2 / 8 + b * np.pi**4 / 5 + b**2 * np.pi**8 / 18 + 0.5
    first = np.array([0.5 * (1 + b * np.pi**4 / 5) ** 2, a**2 / 8, 0.0]) / variance
    both = b**2 * np.pi**8 * (1 / 18 - 1 / 50) / variance
    total = first + np.array([both, 0, both])
    np.testing.assert_allclose(found.first, first, atol=0.04)
    np.testing.assert_allclose(found.total, total, atol=0.04)
    for interval, exact in ((found.first_interval, first), (found.total_interval, total)):
        assert ((interval[:, 0] < exact) & (exact < interval[:, 1])).all()
    assert "p2" in found._repr_html_()


def test_the_analysis_is_that_of_scipy() -> None:
    """The same points, and the values of the closed form, in SciPy's function as its user would call it."""
    given = {k: ("uniform", 1, 4), c: ("uniform", 0.1, 0.3)}
    table = sample(given, 256, method="saltelli", seed=11)
    found = sobol_indices(table, oscillators(table, measures={"x": measures.value_at(x, 2.0)})["x"])

    def result(p: np.ndarray) -> np.ndarray:
        return displacement(p[0], p[1], 0.1, 2.0)[np.newaxis]

    expected = stats.sobol_indices(
        func=result, n=256, dists=[stats.uniform(1, 3), stats.uniform(0.1, 0.2)], rng=11
    )
    np.testing.assert_allclose(found.first, expected.first_order.ravel(), atol=0.02)
    np.testing.assert_allclose(found.total, expected.total_order.ravel(), atol=0.02)


def test_indices_over_time() -> None:
    """At the start, all cases are alike: there are no indices."""
    table = sample({k: ("uniform", 1, 4), c: ("uniform", 0.1, 0.3)}, 64, method="saltelli")
    t = np.linspace(0, 4, 5)
    values = displacement(table[k][:, None], table[c][:, None], 0.1, t)
    found = sobol_indices(table, values)
    assert found.first.shape == (2, 5)
    assert np.isnan(found.first[:, 0]).all()
    alone = sobol_indices(table, values[:, 3], resamples=10)
    np.testing.assert_allclose(found.total[:, 3], alone.total)
    with pytest.raises(ArgumentError, match="these are indices over time"):
        found.plot()
