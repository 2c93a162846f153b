"""Drawings have the titles, labels, legends and limits that the sheet gives them."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from matplotlib.figure import Figure

from symbody.worksheet.drawing.pieces import _fill, pieces_of
from symbody.worksheet.interpreter.interpret import Interpreter
from symbody.worksheet.values.value import Plot
from tests.worksheet.printed_by import failures, printed


def axes_of(sheet: str) -> Any:
    """Return the axes on which the last drawing of a sheet is drawn."""
    interpreter = Interpreter()
    printed(f"with(plots): with(plottools): {sheet}:", None, interpreter)
    plot = interpreter.session.last[0]
    assert isinstance(plot, Plot)
    axes = Figure().add_subplot()
    _fill(axes, pieces_of(plot), dict(plot.options))
    return axes


def legend_of(axes: Any) -> list[str]:
    legend = axes.get_legend()
    return [] if legend is None else [text.get_text() for text in legend.get_texts()]


def test_each_curve_of_a_motion_has_options_of_its_own() -> None:
    axes = axes_of(
        "s := dsolve({diff(x(t),t) = -x(t), x(0) = 1}, numeric): "
        "odeplot(s, [[t, x(t), color = red], [t, -x(t), thickness = 3]], 0..1, linestyle = dash)"
    )
    one, other = axes.get_lines()
    assert (one.get_color(), other.get_linewidth(), one.get_linestyle()) == ("red", 3.0, "--")
    assert other.get_ydata()[0] == pytest.approx(-1)


def test_shapes_wait_for_the_values_of_their_names() -> None:
    interpreter = Interpreter()
    sheet = (
        "with(plots): with(plottools): link := line([0,0], [L*cos(q),L], color = blue): link; "
        "both := display(link, circle([0,0],r)): both; L := 2: r := 1:"
    )
    assert printed(sheet, None, interpreter) == [
        "line([0, 0],[L*cos(q), L],color = blue)",
        "display(line([0, 0],[L*cos(q), L],color = blue),circle([0, 0],r))",
    ]
    printed("subs(q=0, both):", None, interpreter)
    plot = interpreter.session.last[0]
    assert isinstance(plot, Plot)
    assert pieces_of(plot)[0].points.tolist() == [[0, 0], [2, 2]]


def test_one_curve_names_its_axes() -> None:
    axes = axes_of('plot(sin(x), x = 0..2, title = "A sine")')
    assert (axes.get_xlabel(), axes.get_ylabel(), axes.get_title()) == ("x", "sin(x)", "A sine")
    assert legend_of(axes) == []


def test_several_curves_have_a_legend_and_share_an_axis() -> None:
    axes = axes_of("plot([sin(x), cos(x)], x = 0..2)")
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("x", "")
    assert legend_of(axes) == ["sin(x)", "cos(x)"]
    assert legend_of(axes_of('plot([x, x^2], x = 0..2, legend = ["one", "two"])')) == ["one", "two"]


def test_labels_and_looks_of_curves() -> None:
    axes = axes_of(
        'plot([x, x^2], x = 0..1, labels = ["time", "place"], color = [red, blue], linestyle = [solid, dash], '
        "thickness = 3, gridlines = true)"
    )
    first, second = axes.get_lines()
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("time", "place")
    assert (first.get_color(), second.get_color()) == ("red", "blue")
    assert (first.get_linestyle(), second.get_linestyle(), first.get_linewidth()) == ("-", "--", 3.0)
    assert axes.xaxis.get_gridlines()[0].get_visible()


@pytest.mark.parametrize(
    ("options", "limits"),
    [
        ("y = 0..1/2", (None, (0.0, 0.5))),
        ("view = [0..2, -1..3]", ((0.0, 2.0), (-1.0, 3.0))),
        ("view = -2..2", (None, (-2.0, 2.0))),
    ],
)
def test_limits(options: str, limits: tuple[tuple[float, float] | None, tuple[float, float]]) -> None:
    axes = axes_of(f"plot(x^2, x = -1..1, {options})")
    assert axes.get_ylim() == limits[1]
    assert limits[0] is None or axes.get_xlim() == limits[0]


def test_motions_are_labelled() -> None:
    solution = "sol := dsolve({diff(x(t),t) = v(t), diff(v(t),t) = -x(t), x(0) = 1, v(0) = 0}, numeric):"
    axes = axes_of(f'{solution} odeplot(sol, [[t, x(t)], [t, v(t)]], 0..1, legend = ["place", "speed"])')
    assert (axes.get_xlabel(), legend_of(axes)) == ("t", ["place", "speed"])
    assert axes_of(f"{solution} odeplot(sol, [x(t), v(t)], 0..1)").get_xlabel() == "x(t)"


def test_an_option_that_is_not_known_is_told() -> None:
    interpreter = Interpreter()
    printed("plot(x, x = 0..1, funny = 3, symbol = circle):", None, interpreter)
    assert interpreter.session.notices == ["plot: the option funny is not known, and is ignored"]


def test_animations_need_no_network_and_are_the_same_each_time(tmp_path: Path) -> None:
    pages = []
    for name in ("a", "b"):
        printed("plots[animate](plot, [a*x, x = 0..1], a = 0..1, frames = 2);", tmp_path / name)
        pages.append((tmp_path / name / "plot1.html").read_text(encoding="utf-8"))
    assert pages[0] == pages[1]
    assert "https:" not in pages[0]
    assert ">\u25b6</button>" in "".join(pages[0].split())


def test_drawings_are_moved_about_points_and_along_axes() -> None:
    sheet = "s := line([1,0],[2,0]): rotate(s,Pi/2), rotate(s,Pi,[1,0]), translate(s,1,2), scale(s,2,3,[1,1])"
    axes = axes_of(f"{sheet}: display([%])")
    places = [np.round(line.get_xydata(), 9).tolist() for line in axes.lines]
    assert places == [[[0, 1], [0, 2]], [[1, 0], [0, 0]], [[2, 2], [3, 2]], [[1, -2], [3, -2]]]


def test_drawings_in_space_are_not_turned_in_the_plane() -> None:
    sheet = "with(plottools): s := line([0,0],[1,0]): rotate(sphere([0,0,0],1), Pi); rotate(s,1,2); translate(s,1,2,3);"
    assert failures(sheet) == [
        "rotate: 2 values for a drawing in 3 dimensions; expected one a dimension",
        "rotate: expected a drawing and an angle, or a drawing in space and three angles",
        "translate: 3 values for a drawing in 2 dimensions; expected one a dimension",
    ]
