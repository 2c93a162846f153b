"""The page: right numbers, nothing from a network, and a browser that draws it."""

from __future__ import annotations

import errno
import json
import re
from dataclasses import replace
from pathlib import Path
from time import monotonic
from xml.etree import ElementTree

import numpy as np
import pytest
from matplotlib.image import imread
from scipy.spatial.transform import Rotation

from symbody import Body, Force, Point, System, Torque, functions_of_time, ground, rotate, translate
from symbody.errors import PictureError, ViewError
from symbody.view import Box, animate, plot
from tests.view.browser import PATIENCE, browser
from tests.view.prescribed import (
    Prescribed,
    g,
    hanging_plate,
    l,
    m,
    phi,
    q1,
    q2,
    swinging,
    theta,
    tumbling,
    x,
    xA,
    xB,
    y,
    yA,
    yB,
    z,
)

needs_browser = pytest.mark.needs("chromium")
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


def test_a_planar_body_lies_along_its_arms_and_a_disc_stays_flat(tmp_path: Path) -> None:
    frame = translate(x, y, 0) * rotate("Z", phi)
    beam, wheel = (
        Body(frame, 3, Iz=4, name="beam"),
        Body(translate(x, y, 0), 1, 0.01, 0.01, 0.02, name="wheel"),
    )
    strut = Force(ground, 0, 1, 0, at=Point(frame, 1.2, 1.6, 0), on=beam)
    t = np.linspace(0, 1, 11)
    motion = Prescribed(
        t, System([beam, wheel], [strut], coordinates=[x, y, phi]), {x: 9 * t, y: t, phi: t}, {}
    )
    bodies = scene_of(animate(motion, tmp_path / "p.html"))["bodies"]
    box, disc = (body["parts"][0] for body in bodies)
    assert box["size"][0] == pytest.approx(4), "12 I/m = l^2"
    assert np.abs(np.array(box["rotation"])[:, 0]) == pytest.approx([0.6, 0.8, 0])
    thickness = np.linalg.norm(np.subtract(disc["to"], disc["from"]))
    assert disc["radius"] == pytest.approx(0.2)
    assert thickness < disc["radius"] / 2


def test_the_axes_of_ground_are_in_the_picture(tmp_path: Path) -> None:
    view = scene_of(animate(swinging(1.0), tmp_path / "p.html"))["view"]
    assert (np.max(view["extremes"], axis=0) >= 0.25 * view["radius"] - 1e-6).all()


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
    assert {rod["body"] for rod in scene["links"]} == {1}, "the shape of the upper rod stands for its links"
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
        ViewError, match="a shape for stranger, which is not a body of the system; expected one of box"
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


@pytest.mark.parametrize("name", ["swing.gif", "swing.mp4", "swing", "swing.html.txt"])
def test_a_page_has_the_name_of_a_page(name: str, tmp_path: Path) -> None:
    with pytest.raises(ViewError) as caught:
        animate(swinging(1.0), tmp_path / name)
    ending, stem = Path(name).suffix, Path(name).stem
    assert str(caught.value) == (
        f"animate: {tmp_path / name} ends in {ending!r}, but the page is written in HTML; expected a name such "
        f"as {stem}.html"
    )
    assert list(tmp_path.iterdir()) == []


def test_without_a_path_a_notebook_shows_the_page(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The frame holds the bytes of the file, and no file is written."""
    monkeypatch.chdir(tmp_path)
    shown = animate(swinging(1.0), title="Rods & <joints>")
    assert not list(tmp_path.iterdir())
    frame = ElementTree.fromstring(shown._repr_html_())
    assert frame.tag == "iframe"
    assert frame.get("title") == "Rods & <joints>"
    file = animate(swinging(1.0), tmp_path / "p.html", title="Rods & <joints>")
    assert (
        frame.get("srcdoc").split() == file.read_text(encoding="utf-8").split()
    )  # XML has no line breaks there
    assert re.fullmatch(r"Animation\(Rods & <joints>, 0\.\d MB; a notebook shows it, .*\)", repr(shown))


@pytest.mark.parametrize("name", ["swing.htm", "swing.HTML"])
def test_pages_and_figures_make_their_folders(name: str, tmp_path: Path) -> None:
    assert animate(swinging(1.0), tmp_path / "new" / "folder" / name).is_file()
    plot(swinging(1.0), path=tmp_path / "another" / "swing.png")
    assert (tmp_path / "another" / "swing.png").is_file()


def test_natural_coordinates_show_points_and_threads(tmp_path: Path) -> None:
    motion = hanging_plate()
    scene = scene_of(animate(motion, tmp_path / "p.html", reactions=True))
    v = motion.variables
    A, B = (np.column_stack([v[x], v[y], 0 * motion.t]) for x, y in ((xA, yA), (xB, yB)))
    assert [point["name"] for point in scene["points"]] == ["A", "B", "", ""]
    for point, path in zip(scene["points"], (A, B, 0 * A, 0 * A + [0.5, 0, 0]), strict=True):
        np.testing.assert_allclose(np.reshape(point["path"], (-1, 3)), path, atol=1e-6)
    ends = [(line["from"], line["to"]) for line in scene["lines"]]
    np.testing.assert_allclose(np.reshape(ends[0], (2, -1, 3)), [A, 0 * A], atol=1e-6)
    np.testing.assert_allclose(np.reshape(ends[1], (2, -1, 3)), [B, 0 * B + [0.5, 0, 0]], atol=1e-6)
    assert len(ends) == 2, "the bar itself is no thread"
    arms = [rod for rod in scene["links"] if rod["pose"] == scene["bodies"][0]["pose"]]
    np.testing.assert_allclose([rod["to"] for rod in arms], [[-0.25, 0, 0], [0.25, 0, 0]], atol=1e-6)
    # phi_q lambda: at A 2 lambda (A - A0), from 2 to 6; at B lambda (B - B0), from 2 to 4; the threads have length 1.
    assert scene["largest"] == {"reaction": 6.0}
    first, second = (np.reshape(arrow["vector"], (-1, 3)) for arrow in scene["arrows"])
    np.testing.assert_allclose(
        first, -A * (2 + 2 * motion.t)[:, None] * np.linalg.norm(first[-1]) / 6, atol=1e-6
    )
    np.testing.assert_allclose(second[-1], first[-1] * 4 / 6, atol=1e-6)


def test_names_alone_are_not_believed(tmp_path: Path) -> None:
    """Coordinates called x1, y1 that place no point of a body are not drawn as one."""
    x1, y1 = functions_of_time("x1 y1")
    body = Body(rotate("Z", x1) * translate(1, 0, 0) * rotate("X", y1), m, 1, 1, 1)
    motion = tumbling()
    system = System([body], coordinates=[x1, y1], constraints=[x1**2 + y1**2 - 1])
    strange = replace(motion, system=system, variables={x1: np.cos(motion.t), y1: np.sin(motion.t)})
    scene = scene_of(animate(strange, tmp_path / "p.html"))
    assert (scene["points"], len(scene["links"])) == ([], 1)


def test_joints_that_slide_have_a_guide(tmp_path: Path) -> None:
    motion = tumbling()
    system = System([Body(translate(0, 1, 0) * translate(x, 0, 0), m)], coordinates=[x])
    scene = scene_of(animate(replace(motion, system=system), tmp_path / "p.html"))
    (guide,) = [rod for rod in scene["links"] if rod.get("thin")]
    np.testing.assert_allclose([guide["from"], guide["to"]], [[-0.2, 0, 0], [2.2, 0, 0]])


def test_torques_and_forces_of_choice(tmp_path: Path) -> None:
    motion = swinging(1.0)
    upper, lower = motion.system.bodies
    loads = [
        Torque(ground, 0, 0, 3 * g, on=lower, reaction=upper, name="M"),
        Force(ground, 0, -2, 0, at=lower.center_of_mass, on=lower),
    ]
    scene = scene_of(animate(motion, tmp_path / "p.html", forces=loads))
    assert [arrow["kind"] for arrow in scene["arrows"]] == ["torque", "torque", "force"]
    assert scene["largest"] == {"torque": 29.4, "force": 2.0}
    there, back, force = (np.reshape(arrow["vector"], (-1, 3))[0] for arrow in scene["arrows"])
    longest = 0.45 * scene["view"]["radius"]
    np.testing.assert_allclose(
        [there, back, force], [[0, 0, longest], [0, 0, -longest], [0, -longest, 0]], rtol=1e-6
    )


def test_the_camera_goes_with_a_body(tmp_path: Path) -> None:
    motion = tumbling()
    (box,) = motion.system.bodies
    still, moving = (scene_of(animate(motion, tmp_path / "p.html", follow=body)) for body in (None, box))
    v = motion.variables
    np.testing.assert_allclose(
        np.reshape(moving["follow"], (-1, 3)), np.column_stack([v[x], v[y], 0 * v[z]]), atol=1e-6
    )
    sizes = [np.ptp(scene["view"]["extremes"], axis=0) for scene in (still, moving)]
    assert sizes[0][0] > 2, "x goes to 2"
    assert sizes[1][0] < 0.5, "the box is 0.3 long"
    assert abs(sizes[0][2] - sizes[1][2]) < 0.1, "heights are seen as they are"
    with pytest.raises(
        ViewError, match="stranger to follow is not a body of the system; expected one of box"
    ):
        animate(motion, tmp_path / "p.html", follow=Body(translate(x, 0, 0), 1, name="stranger"))


def test_solids_that_hide_others_are_glass(tmp_path: Path) -> None:
    hull = translate(x, y, z)
    bodies = [Body(hull, m, m, m, m, name="hull"), Body(hull * rotate("Z", phi), 0, 0, 0, m, name="wheel")]
    motion = tumbling()
    system = System(bodies, coordinates=[x, y, z, phi])
    shown = scene_of(animate(replace(motion, system=system), tmp_path / "p.html"))["bodies"]
    assert [body["parts"][0]["glass"] for body in shown] == [True, False]
    rods = scene_of(animate(swinging(1.0), tmp_path / "rods.html"))["bodies"]
    assert not any(rod["parts"][0]["glass"] for rod in rods)


@pytest.mark.parametrize(
    ("wish", "message"),
    [
        ({"frames": ["a"]}, "animate: 'a' in frames; expected frames, such as"),
        ({"points": Point(ground, 0, 0, 0, name="P")}, "animate: P in points; expected a list of points"),
        ({"traces": [x]}, "animate: x in traces; expected points"),
        ({"lines": [Point(ground, 0, 0, 0, name="P")]}, "animate: P in lines; expected pairs of points"),
        ({"forces": [3]}, "animate: 3 in forces; expected forces and torques, such as"),
        ({"shapes": [1]}, r"animate: \[1\] in shapes; expected shapes by body"),
    ],
)
def test_wishes_that_make_no_sense(wish: dict, message: str, tmp_path: Path) -> None:
    with pytest.raises(ViewError, match=message):
        animate(tumbling(), tmp_path / "p.html", **wish)
    assert not list(tmp_path.iterdir())


def test_a_page_that_is_not_finished_is_not_there(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A full disk in the middle of writing: what was there before stays, and nothing else is left."""
    file = animate(tumbling(), tmp_path / "p.html")
    before = file.read_bytes()

    def full(self: Path, text: str, **_: object) -> None:
        self.write_bytes(text[:1000].encode())
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr(Path, "write_text", full)
    with pytest.raises(
        PictureError, match=r"p.html can't be written \(No space left on device\); nothing was changed"
    ):
        animate(tumbling(), file, title="Other")
    assert (file.read_bytes(), list(tmp_path.iterdir())) == (before, [file])


# --- in a browser ---


def alike(picture: np.ndarray, color: str) -> np.ndarray:
    """Return where a picture has a colour, in light or shade."""
    hue = np.array([int(color[k : k + 2], 16) for k in (1, 3, 5)], dtype=float)
    pixels = picture[:, :, :3]
    return pixels @ (hue / np.linalg.norm(hue)) > 0.99 * np.maximum(np.linalg.norm(pixels, axis=2), 1e-9)


@needs_browser
def test_a_browser_shows_it(tmp_path: Path) -> None:
    """From a file, without a network and without an error; and it plays."""
    file = animate(swinging(1.0), tmp_path / "page.html", forces=True)
    with browser() as page:
        page.open(f"{file.as_uri()}#t=0.5")
        page.wait_for("document.body.dataset.drawn > 0")
        picture = imread(page.picture(tmp_path / "page.png"))
        picture[:120, 700:] = 1.0  # the legend
        for color in ("#1f77b4", "#ff7f0e", "#c2185b"):  # both rods and the force
            rows, columns = np.nonzero(alike(picture[:530], color))  # above the bar
            assert len(rows) > 300
            assert 200 < columns.mean() < 700, "in the middle"
            assert 150 < rows.mean() < 450
            assert columns.min() > 20, "nothing is cut off"
            assert columns.max() < 880
        slider = "Number(document.getElementById('time').value)"
        assert page.evaluate(slider) == pytest.approx(0.5)
        page.evaluate("document.getElementById('play').click()")
        page.wait_for(f"{slider} != 0.5")
        page.evaluate("document.getElementById('play').click()")
        now = page.evaluate(slider)
        text = page.evaluate("document.getElementById('clock').textContent")
        assert text == f"t = {now:.2f} / 1.00"
        page.evaluate("document.querySelector('#legend div').click()")
        page.wait_for("document.querySelector('#legend div').style.opacity == '0.4'")
        assert page.console == []
        assert [address for address in page.requests if not address.startswith("data:")] == [file.as_uri()]


@needs_browser
def test_a_browser_shows_it_in_the_frame_of_a_notebook(tmp_path: Path) -> None:
    """The frame lets no script of the page reach the notebook, so it is judged by its picture alone."""
    file = tmp_path / "notebook.html"
    shown = animate(swinging(1.0))
    file.write_text(f"<!DOCTYPE html><body>{shown._repr_html_()}</body>", encoding="utf-8")
    with browser() as page:
        page.open(file.as_uri())
        end, areas = monotonic() + PATIENCE, [0]
        while min(areas) < 300:
            assert monotonic() < end, f"the rods never appeared: {areas}"
            picture = imread(page.picture(tmp_path / "page.png"))[:430]  # above the bar
            areas = [np.count_nonzero(alike(picture[:, :650], color)) for color in ("#1f77b4", "#ff7f0e")]
        assert page.console == []
        assert page.evaluate("document.querySelector('iframe').contentDocument") is None


@needs_browser
def test_an_error_in_the_page_is_seen(tmp_path: Path) -> None:
    """The browser that the tests look through tells of errors and of addresses that it asks for."""
    file = tmp_path / "bad.html"
    file.write_text(
        "<title>x</title><img src='http://localhost:9/a.png'><script>console.error('one'); none.two</script>"
    )
    with browser() as page:
        page.open(file.as_uri())
        page.wait_for("document.images[0].complete")
        assert "one" in page.console
        assert any("none is not defined" in line for line in page.console)
        assert any(address.endswith("a.png") for address in page.requests)
