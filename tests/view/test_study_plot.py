"""Plots of studies and fits show what they are asked for."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from symbody import Experiment, Measurement, fit, measures, sample, sobol_indices, statistics
from symbody.errors import ArgumentError
from tests.simulation.oscillator import OSCILLATOR, c, displacement, k, m, oscillators, u, x

CASES = sample({k: ("uniform", 1, 4), c: ("uniform", 0.1, 0.3)}, 16)
STUDY = oscillators(
    CASES,
    np.linspace(0, 6, 13),
    measures={"low": measures.minimum(x), "never": measures.first_crossing(x - 1)},
    outputs={"x": x},
    statistics=[statistics.moments(), statistics.extremes(), statistics.quantiles(0.05, 0.5, 0.95)],
    units={"x": "m", "low": "m", "k": "N/m"},
)


def test_an_output_over_time() -> None:
    (axes,) = STUDY.plot("x", title="sixteen oscillators").axes
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("t [s]", "x [m]")
    labels = [text.get_text() for text in axes.get_legend().get_texts()]
    assert labels == ["extremes", "5 % to 95 %", "mean", "median"]
    mean = next(line for line in axes.lines if line.get_label() == "mean")
    np.testing.assert_array_equal(mean.get_ydata(), STUDY.over_time("x")["mean"])


def test_a_measure_and_its_parameter(tmp_path: Path) -> None:
    (axes,) = STUDY.plot("low", path=tmp_path / "low.svg").axes
    assert axes.get_xlabel() == "low [m]"
    areas = [bar.get_height() * bar.get_width() for bar in axes.patches]
    assert sum(areas) == pytest.approx(1)
    assert (tmp_path / "low.svg").exists()
    (axes,) = STUDY.plot("low instant", against=k).axes
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("k [N/m]", "low instant [s]")
    np.testing.assert_array_equal(
        axes.collections[0].get_offsets(), np.array([CASES[k], STUDY["low instant"]]).T
    )


def test_a_measure_that_no_case_has() -> None:
    (axes,) = STUDY.plot("never").axes
    assert [text.get_text() for text in axes.texts] == ["no case has a value"]
    with pytest.raises(ArgumentError, match="expected one of the measures low, low instant, never"):
        STUDY.plot("lowest")


def test_indices_with_their_intervals() -> None:
    table = sample({k: ("uniform", 1, 4), c: ("uniform", 0.1, 0.3)}, 16, method="saltelli")
    found = sobol_indices(table, displacement(table[k], table[c], 0.1, 2.0), resamples=20)
    (axes,) = found.plot().axes
    heights = [bar.get_height() for bar in axes.patches]
    np.testing.assert_allclose(heights, [*found.first, *found.total])
    assert [text.get_text() for text in axes.get_xticklabels()] == ["k", "c"]


def test_a_fit_with_its_residuals() -> None:
    t = np.linspace(0, 3, 16)
    rows = [
        Measurement(x, t, displacement(4.0, 0.2, 0.1, t), deviation=0.01),
        Measurement(u, [1.0], [-0.17], deviation=1),
    ]
    found = fit(OSCILLATOR, Experiment(rows, initial={x: 0.1}), {m: 1.0}, unknown={k: 3.5, c: 0.1})
    axes = found.plot().axes
    assert len(axes) == 4
    assert axes[1].get_ylabel() == "residual /\ndeviation"
    np.testing.assert_array_equal(axes[1].lines[0].get_ydata(), found.residuals[:16])
    assert [len(each.lines[0].get_xdata()) for each in axes] == [16, 16, 1, 1]
