"""Motions from `simulate` draw themselves: what the figure and the page show is what was computed."""

from __future__ import annotations

import json
import re
from pathlib import Path

import numpy as np
import pytest
from matplotlib.image import imread

import symbody as sb
from symbody.errors import SimulationError
from tests.view.browser import browser

m, l, g, k = sb.symbols("m l g k")
x, y = sb.functions_of_time("x y")


@pytest.fixture(scope="module")
def swing() -> sb.Motion:
    """A bob on a thread, in its coordinates: the thread is a constraint."""
    bob = sb.Body(sb.translate(x, y, 0), m, name="bob")
    gravity = sb.Vector(sb.ground, 0, -g, 0)
    pendulum = sb.System([bob], coordinates=[x, y], constraints=[x**2 + y**2 - l**2], gravity=gravity)
    equations = sb.newton_euler(pendulum)
    numbers = {m: 2.0, l: 1.5, g: 9.81}
    return sb.simulate(equations, numbers, {x: 0.9}, t=np.linspace(0, 2, 81), guess={y: -1})


def scene_of(page: Path) -> dict:
    return json.loads(re.search(r'id="scene">(.*?)</script>', page.read_text(), re.DOTALL)[1])


def test_the_page_has_the_path_and_the_tension(swing: sb.Motion, tmp_path: Path) -> None:
    """The tension of a pendulum that starts at rest at height y0 is ``m g (3 cos - 2 cos0) = m g (2 y0 - 3 y)/l``."""
    scene = scene_of(swing.animate(tmp_path / "swing.html", reactions=True))
    bob = np.reshape(scene["poses"][scene["bodies"][0]["pose"]], (-1, 7))[:, :2]
    np.testing.assert_allclose(bob, swing.states[:, :2], atol=1e-6)
    (arrow,) = scene["arrows"]
    pull = np.reshape(arrow["vector"], (-1, 3))[:, :2]
    np.testing.assert_allclose(pull[:, 0] * bob[:, 1], pull[:, 1] * bob[:, 0], atol=1e-5)
    tension = 2.0 * 9.81 * (2 * -1.2 - 3 * bob[:, 1]) / 1.5
    shown = np.linalg.norm(pull, axis=1)
    np.testing.assert_allclose(shown / shown.max(), tension / tension.max(), atol=1e-5)
    assert scene["largest"] == {"reaction": pytest.approx(tension.max(), rel=5e-3)}, "three digits"


def test_the_figure_has_the_curves_and_their_units(swing: sb.Motion, tmp_path: Path) -> None:
    figure = swing.plot(path=tmp_path / "swing.png")
    left, right = figure.axes
    assert (left.get_ylabel(), right.get_ylabel()) == ("length [m]", "velocity [m/s]")
    for line, column in zip([*left.lines, *right.lines], swing.states.T, strict=True):
        np.testing.assert_array_equal(line.get_ydata(), column)
    assert imread(tmp_path / "swing.png").std() > 0.05


def test_what_was_computed_before_a_failure_can_be_looked_at(tmp_path: Path) -> None:
    """A mass falls into a centre of attraction: after ``pi/(2 sqrt(2))`` s it is there."""
    frame = sb.translate(x, 0, 0)
    mass = sb.Body(frame, m, name="mass")
    pull = sb.Force(sb.ground, -k / x**2, 0, 0, at=sb.Point(frame, 0, 0, 0), on=mass)
    equations = sb.newton_euler(sb.System([mass], [pull], coordinates=[x]))
    with pytest.raises(SimulationError) as failure:
        sb.simulate(equations, {m: 1, k: 1}, {x: 1}, t=(0, 2))
    motion = failure.value.motion
    assert motion.t[-1] == pytest.approx(np.pi / 2**1.5, abs=1e-4)
    page = motion.animate(tmp_path / "fall.html")
    assert scene_of(page)["times"][-1] == pytest.approx(motion.t[-1])
    assert motion.plot().axes[0].get_xlim()[1] == pytest.approx(motion.t[-1])


@pytest.mark.needs("chromium")
def test_a_browser_shows_it_without_a_word(swing: sb.Motion, tmp_path: Path) -> None:
    file = swing.animate(
        tmp_path / "swing.html", reactions=True, traces=[swing.system.bodies[0].center_of_mass]
    )
    with browser() as page:
        page.open(f"{file.as_uri()}#t=1")
        page.wait_for("document.body.dataset.drawn > 0")
        assert imread(page.picture(tmp_path / "page.png")).std() > 0.02
        assert page.console == []
        assert [address for address in page.requests if not address.startswith("data:")] == [file.as_uri()]
