"""Plots: curves, names and units."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from symbody.errors import PictureError, ViewError
from symbody.view import plot
from tests.view.prescribed import q1, q2, swinging


def test_panels_have_names_units_and_the_values() -> None:
    motion = swinging(1.0)
    figure = plot(motion, q1, {"a": q1, "b": q2}, units={q1: "rad", q2: "rad"}, title="Swing")
    first, second = figure.axes
    assert (first.get_ylabel(), second.get_ylabel()) == (f"${q1.latex()}$ [rad]", "[rad]")
    assert second.get_xlabel() == "time [s]"
    assert [text.get_text() for text in second.get_legend().get_texts()] == ["a", "b"]
    np.testing.assert_array_equal(second.lines[1].get_ydata(), motion.variables[q2])


def test_files_and_mistakes(tmp_path: Path) -> None:
    motion = swinging(0.5)
    plot(motion, path=tmp_path / "all.svg")
    assert (tmp_path / "all.svg").read_text().startswith("<?xml")
    with pytest.raises(ViewError, match="plot: a panel is empty"):
        plot(motion, [])
    with pytest.raises(ViewError, match="ends in 'doc'; expected a format such as"):
        plot(motion, path=tmp_path / "all.doc")
    with pytest.raises(PictureError, match="nothing was changed there"):
        plot(motion, path=tmp_path / "all.svg" / "x.png")
