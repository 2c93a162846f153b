"""Plots: curves, names and units."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from matplotlib.figure import Figure

from symbody import (
    Body,
    Force,
    System,
    floating_frame,
    functions_of_time,
    ground,
    moving_frame,
    origin,
    rotate,
    symbols,
    translate,
)
from symbody.errors import PictureError, ViewError
from symbody.view import plot
from symbody.view.figure import NotebookFigure
from symbody.view.overview import overview
from tests.view.prescribed import hanging_plate, q1, q2, swinging, tumbling


def test_panels_have_names_units_and_the_values() -> None:
    motion = swinging(1.0)
    figure = plot(motion, q1, {"a": q1, "b": q2}, units={q1: "rad", q2: "rad"}, title="Swing")
    first, second = figure.axes
    assert (first.get_ylabel(), second.get_ylabel()) == (f"${q1.latex()}$ [rad]", "angle [rad]")
    assert second.get_xlabel() == "time [s]"
    assert [text.get_text() for text in second.get_legend().get_texts()] == ["a", "b"]
    np.testing.assert_array_equal(second.lines[1].get_ydata(), motion.variables[q2])


def test_axes_have_the_name_that_curves_share() -> None:
    motion = swinging(1.0)
    share = {"angle of the upper rod": q1 * 2, "angle of the lower rod": q1 + q2}
    panels = [[q1, q2], share, {"$a b$": 2 * q1, "$a c$": 2 * q2}]
    angles, common, symbols_alone = shown(plot(motion, *panels))
    assert angles == ("angle [rad]", [f"${q1.latex()}$", f"${q2.latex()}$"])
    assert common == ("angle", ["upper rod", "lower rod"])
    assert symbols_alone == ("", ["$a b$", "$a c$"])
    mixed = {"upper": q1, "sum": q1 + q2}
    assert [label for label, _ in shown(plot(motion, mixed, units={"sum": "rad"}))] == [""]


def shown(figure: Figure) -> list[tuple[str, list[str]]]:
    """Return what stands at each pair of axes, and its curves."""
    return [
        (axes.get_ylabel(), [line.get_label() for line in axes.lines])
        for axes in figure.axes
        if axes.get_visible()
    ]


def test_without_a_panel_kinds_stand_apart() -> None:
    assert [label for label, _ in shown(plot(swinging(1.0)))] == ["angle [rad]", "angular velocity [rad/s]"]
    assert [label for label, _ in shown(plot(swinging(1.0), time="ms", units={q1: "deg", q2: "deg"}))] == [
        "angle [deg]",
        "angular velocity [rad/ms]",
    ]
    length, velocity, angle, turning = shown(plot(tumbling()))
    assert length == ("length [m]", ["$x$", "$y$", "$z$"])
    assert angle == ("angle [rad]", [r"$\phi$", r"$\theta$"])
    assert (velocity[0], turning[0]) == ("velocity [m/s]", "angular velocity [rad/s]")
    assert [label for label, _ in shown(plot(hanging_plate()))] == ["length [m]", "velocity [m/s]"]


def test_what_nobody_knows_has_no_unit() -> None:
    """A coordinate that is neither an angle nor a length, as the frames tell; and a rolling wheel's way is a length."""
    s, c, r = *functions_of_time("s c"), symbols("r")
    wheel = translate(s, 0, 0) * rotate("Y", s / r)
    hull = floating_frame("hull")
    bodies = [Body(wheel, 1, 1, 1, 1), Body(hull, 1, 1, 1, 1)]
    system = System(bodies, [Force(hull, c, 0, 0, at=origin(hull), on=bodies[1])], [s, c])
    coordinates, speeds = overview(system)
    assert [(group.kind, group.unit("s"), len(group.expressions)) for group in (*coordinates, *speeds)] == [
        ("length", "m", 4),
        ("component", "", 4),
        ("coordinate", "", 1),
        ("velocity", "m/s", 3),
        ("angular velocity", "rad/s", 3),
        ("velocity", "m/s", 1),
        ("rate", "", 1),
    ]
    assert coordinates[0].unit("") == ""


def test_angles_of_a_moving_frame_and_many_of_a_kind() -> None:
    """Quasi-velocities in a pose: a full turn of psi changes nothing, so it is an angle."""
    x, y, psi, *others = functions_of_time("x y psi a b c d e f g h k")
    u, v, w = functions_of_time("u v r")
    frame = moving_frame(u, v, 0, 0, 0, w, pose=translate(x, y, 0) * rotate("Z", psi))
    system = System([Body(frame, 1, 1, 1, 1)], speeds=[u, v, w])
    coordinates, speeds = overview(system)
    assert [(group.kind, group.expressions) for group in coordinates] == [
        ("length", (x, y)),
        ("angle", (psi,)),
    ]
    assert [(group.kind, group.expressions) for group in speeds] == [
        ("velocity", (u, v)),
        ("angular velocity", (w,)),
    ]
    chain = ground
    for angle in others:
        chain = chain * rotate("Z", angle) * translate(1, 0, 0)
    (first, second), _ = overview(System([Body(chain, 1)], coordinates=others))
    assert (len(first.expressions), len(second.expressions)) == (6, 3)


def test_files_and_mistakes(tmp_path: Path) -> None:
    motion = swinging(0.5)
    plot(motion, path=tmp_path / "all.svg")
    assert (tmp_path / "all.svg").read_text().startswith("<?xml")
    with pytest.raises(ViewError, match="plot: a panel is empty"):
        plot(motion, [])
    with pytest.raises(ViewError, match="plot: 'q1' is not a panel; expected an expression such as"):
        plot(motion, "q1")
    with pytest.raises(ViewError, match="plot: 3 is not a panel"):
        plot(motion, {"a": q1, "b": 3})
    with pytest.raises(ViewError, match="ends in 'doc'; expected a format such as"):
        plot(motion, path=tmp_path / "all.doc")
    with pytest.raises(PictureError, match="nothing was changed there"):
        plot(motion, path=tmp_path / "all.svg" / "x.png")


def test_a_notebook_shows_a_figure_as_a_picture() -> None:
    figure = plot(swinging(), q1)
    assert isinstance(figure, NotebookFigure)
    assert figure._repr_png_().startswith(b"\x89PNG")
