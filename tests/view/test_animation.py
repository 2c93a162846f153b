"""The page: right numbers, nothing from a network, and a browser that draws it."""

from __future__ import annotations

import json
import re
import shutil
import subprocess
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from matplotlib.image import imread
from scipy.spatial.transform import Rotation

from symbody import Body, Point, functions_of_time, translate
from symbody.errors import PictureError, ViewError
from symbody.view import Box, animate
from tests.view.prescribed import l, phi, q1, q2, swinging, theta, tumbling, x, y, z

CHROMIUM = next(
    (found for name in ("chromium", "chromium-browser", "google-chrome") if (found := shutil.which(name))), ""
)
XHTML = "http://www.w3.org/1999/xhtml"  # three.js names the namespace of a canvas; nothing is fetched


def scene_of(file: Path) -> dict:
    text = file.read_text(encoding="utf-8")
    return json.loads(re.search(r'id="scene">(.*?)</script>', text, re.DOTALL)[1])


def test_nothing_comes_from_a_network(tmp_path: Path) -> None:
    text = animate(swinging(1.0), tmp_path / "page.html").read_text(encoding="utf-8")
    assert set(re.findall(r"https?://[^\s\"'`)]+", text)) <= {XHTML}
    assert not re.search(r"<script[^>]+src=|\bimport\(", text)
    assert "Permission is hereby granted" in text


def test_poses_are_those_of_the_angles(tmp_path: Path) -> None:
    motion = tumbling()
    scene = scene_of(animate(motion, tmp_path / "box.html"))
    found = np.reshape(scene["poses"][scene["bodies"][0]["pose"]], (-1, 7))
    v = motion.variables
    np.testing.assert_allclose(found[:, :3], np.column_stack([v[x], v[y], v[z]]), atol=1e-6)
    turned = Rotation.from_euler("ZX", np.column_stack([v[phi], v[theta]]))
    assert (turned.inv() * Rotation.from_quat(found[:, 3:])).magnitude().max() < 1e-6
    assert (np.sum(found[1:, 3:] * found[:-1, 3:], axis=1) > 0).all()  # no jump between the two signs


def test_bodies_are_the_solids_of_their_inertia(tmp_path: Path) -> None:
    (box,) = scene_of(animate(tumbling(), tmp_path / "box.html"))["bodies"]
    np.testing.assert_allclose(sorted(box["parts"][0]["size"]), [0.1, 0.2, 0.3])
    rods = scene_of(animate(swinging(1.0), tmp_path / "rods.html"))["bodies"]
    assert [rod["parts"][0]["size"][0] for rod in rods] == pytest.approx([0.8, 0.8])


def test_traces_shapes_and_forces(tmp_path: Path) -> None:
    motion = swinging(1.0)
    upper, lower = motion.system.bodies
    tip = Point(lower.frame, l / 2, 0, 0, name="tip")
    file = animate(motion, tmp_path / "p.html", shapes={upper: Box(l, 0.1, 0.2)}, traces=[tip], forces=True)
    scene = scene_of(file)
    a, b = motion.variables[q1], motion.variables[q1] + motion.variables[q2]
    expected = 0.8 * np.column_stack([np.cos(a) + np.cos(b), np.sin(a) + np.sin(b), 0 * a])
    np.testing.assert_allclose(np.reshape(scene["points"][0]["path"], (-1, 3)), expected, atol=1e-6)
    assert scene["bodies"][0]["parts"][0]["size"] == [0.8, 0.1, 0.2]
    np.testing.assert_allclose(np.reshape(scene["arrows"][0]["at"], (-1, 3)), expected, atol=1e-6)


def test_what_stays_at_the_origin_fills_the_view(tmp_path: Path) -> None:
    motion = tumbling()
    still = replace(motion, variables={name: 0 * row for name, row in motion.variables.items()})
    scene = scene_of(animate(still, tmp_path / "p.html"))
    assert 0.1 < scene["view"]["radius"] < 0.3
    (box,) = motion.system.bodies
    scene = scene_of(animate(still, tmp_path / "p.html", shapes={box: Box(6, 1, 1)}))
    assert 3 <= scene["view"]["radius"] < 6


def test_equal_motions_give_equal_bytes(tmp_path: Path) -> None:
    first, second = (animate(tumbling(), tmp_path / name).read_bytes() for name in ("a.html", "b.html"))
    assert first == second


def test_what_cannot_be_drawn(tmp_path: Path) -> None:
    motion = tumbling()
    stranger = Body(translate(functions_of_time("s"), 0, 0), 1, name="stranger")
    with pytest.raises(
        ViewError, match="a shape for stranger, which is no body of the system; expected one of box"
    ):
        animate(motion, tmp_path / "p.html", shapes={stranger: Box(1, 1, 1)})
    with pytest.raises(ViewError, match="no instants, so there is nothing to draw"):
        animate(replace(motion, t=np.empty(0)), tmp_path / "p.html")
    broken = {**motion.variables, x: np.where(motion.t > 1, np.nan, 0.0)}
    with pytest.raises(ViewError, match=r"view: x is nan at t = 1.02; expected finite numbers"):
        animate(replace(motion, variables=broken), tmp_path / "p.html")
    (tmp_path / "file").write_text("kept")
    with pytest.raises(PictureError, match=r"p.html can't be written \(.*\); nothing was changed there"):
        animate(motion, tmp_path / "file" / "p.html")
    assert [file.name for file in tmp_path.iterdir()] == ["file"]


@pytest.mark.skipif(not CHROMIUM, reason="no Chromium on this machine: apt-get install chromium")
def test_a_browser_draws_it_without_an_error(tmp_path: Path) -> None:
    file = animate(swinging(1.0), tmp_path / "page.html", forces=True)
    software = ["--disable-gpu", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"]
    picture = tmp_path / "page.png"
    command = [
        CHROMIUM, "--headless", "--no-sandbox", *software, "--enable-logging=stderr", "--window-size=900,600",
        f"--user-data-dir={tmp_path / 'profile'}", f"--screenshot={picture}", "--virtual-time-budget=1000",
        f"{file.as_uri()}#t=0.5",
    ]  # fmt: skip
    done = subprocess.run(command, capture_output=True, text=True, timeout=120, check=True)
    console = [line for line in done.stderr.splitlines() if "CONSOLE" in line and "GPU stall" not in line]
    assert console == []
    pixels = imread(picture)[:, :, :3]
    for color in ([0x1F, 0x77, 0xB4], [0xFF, 0x7F, 0x0E]):  # both rods, in light and shade
        hue = np.array(color) / np.linalg.norm(color)
        middle = pixels[80:520, :740].reshape(-1, 3)
        alike = middle @ hue / np.maximum(np.linalg.norm(middle, axis=1), 1e-9)
        assert (alike > 0.99).sum() > 300
