"""Plots of linear models: labels, units, curves and marks; the page of a mode."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose

from symbody import (
    Linear,
    Matrix,
    Mode,
    RootLocus,
    equations_of,
    errors,
    frequency_response,
    functions_of_time,
    grid,
    impulse_response,
    linearize,
    modes,
    newton_euler,
    root_locus,
    step_response,
    sweep,
    symbols,
    time_derivative,
)
from symbody.models import bicycle, n_pendulum

v = symbols("v")
MODEL = bicycle()
NAMES = {"weave": (5.0, -0.8 + 4.5j), "capsize": (5.0, -0.3)}


@cache
def linear() -> Linear:
    return linearize(
        newton_euler(MODEL.system),
        about={time_derivative(MODEL["x"]): v},
        inputs=[MODEL["T_steer"]],
        outputs=[MODEL["lean"], MODEL["steer"]],
    )


@cache
def locus() -> RootLocus:
    return root_locus(linear(), MODEL.parameters, over={v: np.linspace(0, 10, 30)}, names=NAMES)


@cache
def weave() -> Mode:
    return modes(linear(), {**MODEL.parameters, v: 5.0}).near(-0.8 + 4.5j)


def test_a_locus_is_labelled_and_critical_speeds_are_marked(tmp_path: Path) -> None:
    figure = locus().plot(unit="m/s", path=tmp_path / "locus.png")
    plane, real, imaginary = figure.axes
    assert plane.get_xlabel() == "real part [1/s]"
    assert imaginary.get_xlabel() == "$v$ [m/s]"
    assert (real.get_ylabel(), imaginary.get_ylabel()) == ("real part [1/s]", "imaginary part [rad/s]")
    assert plane.get_title() == "× $v$ = 0 m/s, • $v$ = 10 m/s"
    assert [text.get_text() for text in real.texts] == ["4.292", "6.024"]
    legend = real.get_legend()
    assert legend is not None
    assert {"weave", "capsize"} <= {text.get_text() for text in legend.get_texts()}
    assert (tmp_path / "locus.png").stat().st_size > 10_000
    assert len(locus().plot("plane", real=(-5, 1)).axes) == 1
    assert locus().plot("plane", real=(-5, 1)).axes[0].get_xlim() == (-5, 1)


def test_circles_of_critical_values_differ_from_their_branch() -> None:
    for axes in locus().plot().axes:
        circles = [line for line in axes.lines if line.get_marker() == "o"]
        assert circles
        assert {line.get_color() for line in circles} == {"k"}


def test_phases_have_no_negative_zero() -> None:
    mode = modes(linearize(newton_euler(n_pendulum(2).system)), n_pendulum(2).parameters)[0]
    turned = replace(mode, state=mode.state * np.exp(-1e-9j))
    labels = [text.get_text() for text in turned.plot().axes[0].get_legend().get_texts()]
    assert len(labels) == 2
    assert all(label.endswith(", 0°") for label in labels)


def test_phasors_are_drawn_by_kind(tmp_path: Path) -> None:
    figure = weave().plot(path=tmp_path / "weave.svg")
    assert [axes.get_title() for axes in figure.axes] == ["length [m]", "angle [rad]"]
    assert figure.get_suptitle() == "Bicycle: 0.7106 Hz, damping ratio 0.171"
    legend = figure.axes[1].get_legend()
    assert legend is not None
    assert [text.get_text().partition(":")[0] for text in legend.get_texts()] == [
        "$\\mathrm{yaw}$",
        "$\\mathrm{lean}$",
        "$\\mathrm{steer}$",
    ]


def test_a_mode_is_animated_at_a_visible_amplitude(tmp_path: Path) -> None:
    page = weave().animate(tmp_path / "weave.html")
    text = Path(str(page)).read_text(encoding="utf-8")
    assert "Bicycle: 0.7106 Hz, damping ratio 0.171" in text
    motion = weave().motion()
    angles = np.abs(motion.evaluate([MODEL["yaw"], MODEL["lean"], MODEL["steer"]]))
    assert 0.05 < angles.max() < 0.5
    assert_allclose(motion[MODEL["lean"]][0], motion[MODEL["lean"]][-1], atol=1e-12)
    # the shape is that of the mode: the ratio of lean and steer at the first instant is that of the real parts
    shape = weave().shape
    ratio = motion[MODEL["lean"]][0] / motion[MODEL["steer"]][0]
    assert_allclose(ratio, shape[MODEL["lean"]].real / shape[MODEL["steer"]].real)
    # a capsize falls for three time constants; it is not periodic
    capsize = modes(linear(), {**MODEL.parameters, v: 5.0}).near(-0.3).motion(0.2)
    lean = capsize[MODEL["lean"]]
    assert_allclose(lean[-1] / lean[0], np.exp(-3))


def test_a_pendulum_swings_without_its_steady_speed() -> None:
    model = n_pendulum(1)
    mode = modes(linearize(newton_euler(model.system)), model.parameters)[0]
    motion = mode.motion()
    theta = motion[model["theta1"]]
    assert_allclose(np.abs(theta).max(), 0.15, rtol=1e-9)
    slope = np.gradient(theta, motion.t)[1:-1]
    assert_allclose(motion[time_derivative(model["theta1"])][1:-1], slope, atol=2e-3)
    with pytest.raises(errors.ModelError) as caught:
        motion.evaluate([time_derivative(model["theta1"], 2)])
    assert str(caught.value) == (
        "animate: theta1'' has no value in a mode; expected expressions of coordinates and speeds"
    )


def test_responses_are_labelled() -> None:
    fast = {**MODEL.parameters, v: 5.0}
    response = frequency_response(linear(), fast, np.geomspace(0.1, 100, 50))
    magnitude, phase = response.plot(units={"T_steer": "N m"}).axes
    assert magnitude.get_title() == "input $T_{\\mathrm{steer}}$ [N m]"
    assert phase.get_xlabel() == "frequency [rad/s]"
    assert len(magnitude.lines) == 2
    assert len(response.plot("nyquist").axes) == 1
    for found in (step_response(linear(), fast, 5), impulse_response(linear(), fast, 5)):
        lean, steer = found.plot().axes
        assert lean.get_ylabel() == "$\\mathrm{lean}$ [rad]"
        assert steer.get_xlabel() == "time [s]"


def test_sweeps_are_drawn_over_one_parameter_or_a_grid() -> None:
    trail = MODEL["c"]
    others = {name: value for name, value in MODEL.parameters.items() if name != trail}
    one = sweep(linear(), {**MODEL.parameters, v: np.linspace(1, 8, 20)})
    assert one.plot(units={v: "m/s"}).axes[1].get_xlabel() == "$v$ [m/s]"
    two = sweep(linear(), others, cases=grid({v: np.linspace(1, 8, 12), trail: np.linspace(0.02, 0.1, 5)}))
    axes, colours = two.plot().axes
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("$v$", "$c$")
    assert colours.get_ylabel() == "largest real part [1/s]"  # no line: all cases grow
    assert_allclose([*axes.get_xlim(), *axes.get_ylim()], [1, 8, 0.02, 0.1])  # not half a cell beyond
    x, (stiffness, damping) = functions_of_time("x"), symbols("stiffness damping")
    carts = linearize(equations_of(Matrix([[1]]), [-stiffness * x - damping * time_derivative(x)], [x]))
    crossed = sweep(carts, cases=grid({stiffness: [1, 4], damping: [-0.2, 0.2]})).plot()
    assert crossed.axes[1].get_ylabel() == "largest real part [1/s]; line: limit of stability"
    with pytest.raises(errors.ViewError) as caught:
        sweep(linear(), {**others, v: [1, 2], trail: [0.02, 0.1]}).plot()
    assert str(caught.value) == (
        "plot_sweep: the cases vary v, c; expected those of one parameter, or a grid of two: cases=grid({...})"
    )
