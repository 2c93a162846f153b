"""Reports: their contents are those of the model, in each format, with the same bytes in each run."""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
import unicodedata
from base64 import b64decode
from collections.abc import Callable
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest

from symbody import (
    Body,
    Equations,
    Force,
    Motion,
    Point,
    System,
    Torque,
    Vector,
    contact,
    cos,
    cost,
    floating_frame,
    friction,
    functions_of_time,
    ground,
    lagrange_equations,
    latex,
    motor,
    newton_euler,
    readable,
    report,
    rotate,
    simulate,
    spring,
    symbols,
    t,
    time_derivative,
    time_derivatives,
    torsion_spring,
    translate,
)
from symbody.document import report as public_name
from symbody.document.document import NO_BREAK, Block, Document, Formula, Heading, Math, Picture, Table
from symbody.document.formats.mathml import mathml
from symbody.document.formats.tex_letter import in_text
from symbody.document.report import FORMATS, SECTIONS
from symbody.document.sections.checks import HOLDS, LAWS
from symbody.document.sections.equations import ROWS
from symbody.document.sections.equations import equations as equations_of_motion
from symbody.document.sections.kinematics import kinematics
from symbody.document.sections.mechanism import mechanism
from symbody.document.sections.nomenclature import Entry, nomenclature, row_meaning
from symbody.document.subject import Subject
from symbody.dynamics.display import display
from symbody.dynamics.display.summary import READABLE
from symbody.dynamics.equations.equations import Derived
from symbody.errors import ModelNotice, PictureError, ReportError, SymbodyError
from symbody.models import ClassicSystem, four_bar, full_car, motorcycle, n_pendulum, single_track_car
from tests.document.models import (
    I1,
    I2,
    PARAMETERS,
    beta,
    engine,
    g,
    l,
    m1,
    m2,
    m3,
    numbered_arm,
    phi,
    q,
    r,
    s,
    tau,
)
from tests.page.test_element_forces import block_on_plate
from tests.repeated import repeated
from tests.view.browser import browser

SUFFIXES = sorted(FORMATS)


@pytest.fixture(scope="module")
def equations() -> Equations:
    return lagrange_equations(engine())


@pytest.fixture(scope="module")
def motion(equations: Equations) -> Motion:
    values = dict(zip(PARAMETERS, [0.1, 0.3, 1, 0.5, 0.8, 1e-3, 4e-3, 9.81, 0.5], strict=True))
    return simulate(equations, values, {phi: 1.0}, t=np.linspace(0, 0.2, 41), guess={s: 0.3})


def written(tmp_path: Path, model: Equations | System | ClassicSystem, suffix: str, **options: object) -> str:
    return report(model, tmp_path / f"model{suffix}", **options).read_text(encoding="utf-8")  # type: ignore[arg-type]


def blocks(model: Equations, *sections: Callable[[Subject], list[Block]]) -> Document:
    """Return the blocks of these sections, or of all."""
    subject = Subject(model, None, {}, {}, {})
    return Document("", tuple(block for section in sections or SECTIONS for block in section(subject)))


def cells(document: Document) -> list[tuple[str, ...]]:
    tables = [block for block in document.blocks if isinstance(block, Table)]
    return [
        tuple("".join(w if isinstance(w, str) else w.latex for w in cell) for cell in row)
        for table in tables
        for row in table.rows
    ]


def svg_of(text: str) -> list[ElementTree.Element]:
    return [ElementTree.fromstring(found) for found in re.findall(r"<svg.*?</svg>", text, re.DOTALL)]


def test_the_public_name_is_that_of_the_layer() -> None:
    assert report is public_name


# --- contents ---


def test_the_contents_are_those_of_the_model(equations: Equations) -> None:
    document = blocks(equations)
    assert Formula(equations.latex()) in document.blocks
    rows = cells(document)
    assert ("coordinates", "3") in rows
    assert ("constraints", "2") in rows
    assert (f"{latex(phi)}, {latex(beta)}", "coordinate, angle", "rad") in rows
    assert (latex(s), "coordinate, length", "m") in rows
    assert ("m_{3}", "mass of slider", "kg") in rows
    assert ("I_{2}", "moment of inertia of rod <b> about z", "kg m²") in rows
    assert (latex(g), "acceleration of gravity", "m/s²") in rows
    total = cost(equations.residuals)
    assert next(row for row in rows if row[0] == "residuals")[-1] == str(total.total)
    assert all((law, HOLDS) in rows for law in LAWS)
    assert sum(isinstance(block, Picture) for block in document.blocks) == 1


def test_operations_add_up(equations: Equations) -> None:
    counts = [row for row in cells(blocks(equations)) if len(row) == 6]
    assert len(counts) == 4
    assert all(sum(map(int, row[1:5])) == int(row[5]) for row in counts)


def test_sections_are_in_order(equations: Equations) -> None:
    headings = [block.text for block in blocks(equations).blocks if isinstance(block, Heading)]
    names = "Mechanism, Nomenclature, Kinematics, Energies, Equations of motion, Size, Checks"
    assert ", ".join(headings) == names


def test_a_floating_body_has_quasi_velocities() -> None:
    """Lagrange's equations are those of Boltzmann and Hamel then, and agree."""
    top = System([Body(floating_frame(), m1, I1, I1, I2)], gravity=Vector(ground, 0, 0, -g))
    rows = cells(blocks(newton_euler(top)))
    assert ("u, v, w", "quasi-velocity, velocity", "m/s") in rows
    results = dict(row for row in rows if row[0] in LAWS)
    assert [*results.values()] == [HOLDS, HOLDS, HOLDS]


def test_laws_of_springs_are_told(tmp_path: Path) -> None:
    """A strut is one row with its law, and its constants have units."""
    rows = cells(blocks(newton_euler(full_car().system), mechanism, nomenclature))
    (row,) = (row for row in rows if row[0] == "strut 1")
    assert row[1] == "force"
    assert row[2].startswith(r"\mathrm{cf} \, \dot{l} - \mathrm{kf} ")
    assert row[3:] == ("its line", "body and wheel 1")
    assert (r"\mathrm{cf}", "damping of strut 1 and strut 2", "N s/m") in rows
    assert (r"\mathrm{kr}", "stiffness of strut 3 and strut 4", "N/m") in rows
    assert ("a, b, h, w", "length", "m") not in rows  # parameters are in the order of their names
    assert "~m, " in written(tmp_path, four_bar(), ".tex")


def test_constants_along_a_slide_and_about_a_hinge_have_their_units() -> None:
    """One law is of forces along a slide and of torques about a hinge."""
    x, (m, k, c, d, M, top, low, F, v) = functions_of_time("x"), symbols("m k c d M top low F v")
    for frame, along in ((translate(x, 0, 0), True), (rotate("Z", x), False)):
        body = Body(frame, m, 0, 0, m, name="part")
        loads = [
            torsion_spring(x, k, free_angle=d, damping=c, on=body, name="buffer"),
            motor(x, M, on=body, limit=(low, top), name="drive"),
            friction(x, coulomb=F, creep_speed=v, on=body, name="seal"),
        ]
        rows = cells(blocks(newton_euler(System([body], loads, [x]))))
        effort, length = ("force", "m") if along else ("torque", "rad")
        unit = "N" if along else "N m"
        for row in (
            ("k", "stiffness of buffer", f"{unit}/{length}"),
            ("c", "damping of buffer", f"{unit} s/{length}"),
            ("d", f"free {'length' if along else 'angle'} of buffer", length),
            ("M", f"{effort} of drive", unit),
            (r"\mathrm{top}", f"largest {effort} of drive", unit),
            (r"\mathrm{low}", f"least {effort} of drive", unit),
            ("F", "dry friction of seal", unit),
            ("v", "creep speed of seal", f"{length}/s"),
        ):
            assert row in rows


@pytest.mark.parametrize("letter", ["T", "V", "M"])
def test_letters_of_energies_are_no_names_of_the_model(tmp_path: Path, letter: str) -> None:
    """A motor's torque is often T."""
    x, (m, l, effort) = functions_of_time("x"), symbols(f"m l {letter}")
    arm = Body(rotate("Z", x) * translate(l, 0, 0), m)
    model = System([arm], [Torque(ground, 0, 0, effort, on=arm)], [x], gravity=Vector(ground, 0, -10, 0))
    text = written(tmp_path, newton_euler(model), ".md")
    letters = re.findall(r"(\S+) &= ", text.partition("## Energies")[2].partition("## ")[0])
    assert len(letters) == 2
    assert letter not in letters
    assert (letters == ["T", "V"]) == (letter == "M")


def test_one_constraint_is_told_in_the_singular(tmp_path: Path) -> None:
    (x, y, z), (m, l) = functions_of_time("x y z"), symbols("m l")
    body = Body(translate(x, y, z), m)
    for constraints, said in (
        ([x**2 + y**2 - l**2], "The constraint, whose"),
        ([x, y - l], "The constraints, whose"),
    ):
        model = newton_euler(System([body], coordinates=[x, y, z], constraints=constraints))
        assert said in written(tmp_path, model, ".md")


def test_names_of_one_meaning_share_a_row() -> None:
    """Each name has the number of its link; a few numbers are listed."""
    rows = cells(blocks(newton_euler(numbered_arm(3)), nomenclature))
    assert ("m_{1}, m_{2}, m_{3}", "mass of link 1, 2 and 3", "kg") in rows
    rows = cells(blocks(newton_euler(numbered_arm(5)), nomenclature))
    names = ", ".join(f"m_{{{i}}}" for i in range(1, 6))
    assert (names, "mass of link 1, ..., 5", "kg") in rows


def test_each_name_of_the_kinematics_stands_above_its_use(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Radicands and quantities that occur again use each other: each line has only names of the lines above."""
    monkeypatch.setattr(sys.modules[report.__module__], "SECTIONS", (kinematics,))
    text = written(tmp_path, motorcycle(), ".md").split("whose multipliers")[1].split(r"\end{aligned}")[0]
    rows = [row.split(" &= ") for row in text.split(r" \\ ") if " &= " in row]
    lefts = [left.split()[-1] for left, _ in rows]
    for place, (_, right) in enumerate(rows):
        assert not any(
            re.search(rf"(?<!\w){re.escape(left)}", right) for left in lefts[place:] if left != "0"
        )
    assert any(
        right.startswith(r"\cos(\psi) \dot{x} + \sin(\psi) \dot{y}") for left, right in rows if left == "0"
    )


def test_units_are_added(equations: Equations, tmp_path: Path) -> None:
    assert "| $\\tau$ | torque | N m |" in written(tmp_path, equations, ".md")
    assert "| $\\tau$ | torque | kN m |" in written(tmp_path, equations, ".md", units={tau: "kN m"})


def test_time_and_moments_about_several_axes_are_named() -> None:
    x, (J, I1, m, w) = functions_of_time("x"), symbols("J I1 m w")
    ball = Body(translate(x, 0, 0), m, J, J, J, name="ball")
    disc = Body(translate(x, 0, 0), m, I1, I1, J, name="disc")
    push = Force(ground, cos(w * t), 0, 0, at=ball.center_of_mass, on=ball)
    equations = newton_euler(System([ball, disc], [push], [x]))
    (table,) = (
        block for block in nomenclature(Subject(equations, None, {}, {}, {})) if isinstance(block, Table)
    )
    meanings = [row[1:] for row in table.rows]
    assert (("moment of inertia of ball about x, y and z and of disc about z",), ("kg m²",)) in meanings
    assert (("moment of inertia of disc about x and y",), ("kg m²",)) in meanings
    assert (("time",), ("s",)) in meanings


def test_multipliers_have_the_unit_that_makes_work() -> None:
    """A gap in m has a force in N, a squared length N/m, an angle N m; of unknown lengths nothing is said."""
    x, y, theta, psi, k = *functions_of_time("x y theta psi"), symbols("k")
    frame = translate(x, y, 0) * rotate("Z", theta) * translate(l, 0, 0)
    bodies = [Body(frame, m1, 0, 0, I1), Body(rotate("Z", psi), 0, 0, 0, I2)]
    gaps = [x + l * cos(theta), x**2 + y**2 - l**2, theta - 2 * psi, k * (x - y)]
    system = System(bodies, coordinates=[x, y, theta, psi], constraints=gaps[:3])
    found = {row[0]: row[2] for row in cells(blocks(lagrange_equations(system))) if "multiplier" in row[1]}
    assert list(found.values()) == ["N", "N/m", "N m"]
    system = System(bodies, coordinates=[x, y, theta, psi], constraints=gaps[3:])
    found = {row[0]: row[2] for row in cells(blocks(lagrange_equations(system))) if "multiplier" in row[1]}
    assert list(found.values()) == [""]


def test_a_driven_support_has_no_balance_of_power() -> None:
    """The force that moves it is not a load, so its power is not known."""
    theta, x = functions_of_time("theta x")
    bob = Body(translate(x, 0, 0) * rotate("Z", theta) * translate(0, -l, 0), m1)
    driven = System([bob], coordinates=[theta], gravity=Vector(ground, 0, -g, 0), inputs=[x])
    results = [result for law, result in (r for r in cells(blocks(newton_euler(driven))) if r[0] in LAWS)]
    assert results == [HOLDS, HOLDS, "does not apply (frames move as given functions of time)"]


@pytest.mark.parametrize("law", LAWS)
def test_a_wrong_equation_is_found(equations: Equations, law: str) -> None:
    """A term is lost: the power no longer balances; the mass matrix and the system are as before."""
    wrong = Derived((equations.residuals[0] + tau, *equations.residuals[1:]))
    broken = Equations(equations.system, wrong, equations.assemble)
    assert (LAWS[law](Subject(broken, None, {}, {}, {})) == HOLDS) == ("power" not in law)


# --- formats ---


@pytest.mark.parametrize("suffix", [".html", *repeated(suffix for suffix in SUFFIXES if suffix != ".html")])
def test_the_same_bytes_twice(equations: Equations, motion: Motion, tmp_path: Path, suffix: str) -> None:
    texts = [written(tmp_path, equations, suffix, motion=motion) for _ in range(2)]
    assert texts[0] == texts[1]


def test_the_same_bytes_in_another_process(tmp_path: Path) -> None:
    code = "import sys; from symbody import report; from tests.document.models import numbered_arm\n"
    code += "for path in sys.argv[1:]: report(numbered_arm(2), path)"
    files = [tmp_path / f"other{suffix}" for suffix in SUFFIXES]
    environment = os.environ | {"PYTHONHASHSEED": "1"}
    subprocess.run([sys.executable, "-c", code, *map(str, files)], check=True, env=environment)
    for file in files:
        assert file.read_text(encoding="utf-8") == written(tmp_path, numbered_arm(2), file.suffix)


def test_html_is_well_formed_and_needs_no_network(
    equations: Equations, motion: Motion, tmp_path: Path
) -> None:
    text = written(tmp_path, equations, ".html", motion=motion, title="Crank <1>")
    page = ElementTree.fromstring(text.removeprefix("<!DOCTYPE html>\n"))
    assert page.findtext("head/title") == "Crank <1>"
    formulas = page.findall(".//{http://www.w3.org/1998/Math/MathML}math")
    assert len(formulas) > 20
    assert len(svg_of(text)) == 2
    assert "rod &lt;b&gt;" in text
    addresses = set(re.findall(r"https?://[^\"' ]+", text))
    assert all(address.startswith("http://www.w3.org/") for address in addresses)
    assert "<script" not in text


def test_every_formula_becomes_mathml_without_commands(equations: Equations, tmp_path: Path) -> None:
    page = ElementTree.fromstring(written(tmp_path, equations, ".html").removeprefix("<!DOCTYPE html>\n"))
    for formula in page.findall(".//{http://www.w3.org/1998/Math/MathML}math"):
        content = "".join(formula.itertext())
        assert "\\" not in content
        assert "&" not in content


@pytest.mark.needs("chromium")
@pytest.mark.parametrize("model", [numbered_arm(4), engine()], ids=str)
def test_the_formulas_fit_a_page_of_1200_pixels(model: System, tmp_path: Path) -> None:
    """No formula has to be scrolled, and no table is wider than the page."""
    file = report(model, tmp_path / "model.html")
    with browser() as page:
        page.open(file.as_uri(), size=(1200, 900))
        widths = (
            "[...document.querySelectorAll('.formula')].map(each => [each.scrollWidth, each.clientWidth])"
        )
        found = page.evaluate(widths)
        assert len(found) >= 2
        assert all(needed <= given for needed, given in found)
        assert page.evaluate("document.documentElement.scrollWidth") <= 1200
        assert page.console == []


def test_dots_are_accents_and_signs_are_no_differences() -> None:
    """A browser would set dots in the size of exponents, and spaces around a sign after a relation."""
    element = ElementTree.fromstring(mathml(r"m \ddot{s} = -\lambda - 1"))
    home = "{http://www.w3.org/1998/Math/MathML}"
    assert [over.get("accent") for over in element.iter(f"{home}mover")] == ["true"]
    assert [sign.get("form") for sign in element.iter(f"{home}mo") if sign.text == "\u2212"] == [
        "prefix",
        None,
    ]


def test_loads_are_listed(equations: Equations) -> None:
    rows = cells(blocks(equations))
    assert ("load 1", "torque", r"0, 0, \tau", "ground", "crank_1") in rows
    assert ("gravity", "acceleration", "0, -g, 0", "ground", "all bodies") in rows


def test_an_action_and_its_reaction_have_one_row_with_the_names_of_the_equations() -> None:
    rows = cells(blocks(newton_euler(block_on_plate())))
    assert [row for row in rows if row[1] == "force"] == [
        (
            "the seat",
            "force",
            r"0, 0, N_{\mathrm{the},\mathrm{seat}}",
            "body 1",
            "body 1, and its opposite on body 2",
        ),
        ("rub", "force", r"F_{\mathrm{rub}}, 0, 0", "body 1", "body 1, and its opposite on body 2"),
    ]
    assert "names of forces are defined" in str(blocks(newton_euler(block_on_plate()), mechanism))


def test_a_force_without_a_name_is_listed_by_its_law() -> None:
    (z,), (m, k) = functions_of_time(["z"]), symbols("m k")
    ball = Body(translate(0, 0, z), m)
    floor = contact(ball.center_of_mass, 0, k, on=ball, exponent=1, name="floor")
    mechanisms = blocks(newton_euler(System([ball], [floor], [z])), mechanism)
    assert ("floor", "force", r"0, 0, k \max(0, -z)", "ground", "body 1") in cells(mechanisms)
    assert "names of forces are defined" not in str(mechanisms)


def test_squares_with_one_coefficient_are_one_term() -> None:
    x, y, z, theta = functions_of_time("x y z theta")
    load = Body(translate(x, y, z) * rotate("Y", theta) * translate(0, 0, -l), m1)
    drone = System([Body(translate(x, y, z), m2), load], coordinates=[x, y, z, theta])
    assert any(
        r"T &= \frac{1}{2} \left(m_{1} + m_{2}\right) \left(\dot{x}^{2} + \dot{y}^{2} + \dot{z}^{2}\right)"
        in block.latex
        for block in blocks(newton_euler(drone)).blocks
        if isinstance(block, Formula)
    )


def test_centres_of_mass_are_written_for_the_reader(equations: Equations) -> None:
    """The rod leans down by beta: its centre is at ``r sin(phi) - l sin(beta)/2``."""
    (places,) = [
        block for block in blocks(equations).blocks if isinstance(block, Formula) and "{G}2" in block.latex
    ]
    assert r"r \sin(\phi) - \frac{1}{2} l \sin(\beta)" in places.latex


def test_tex_has_the_curves_of_the_motion(equations: Equations, motion: Motion, tmp_path: Path) -> None:
    text = written(tmp_path, equations, ".tex", motion=motion)
    curves = re.findall(r"\\addplot\[.*\] coordinates \{(.*)\};", text)
    points = [[tuple(map(float, point[1:-1].split(","))) for point in curve.split()] for curve in curves]
    names = [phi, beta, *time_derivatives([phi, beta]), s, time_derivative(s)]  # panels row by row
    for name, curve in zip(names, points, strict=True):
        np.testing.assert_allclose(curve, np.column_stack([motion.t, motion[name]]), rtol=1e-5, atol=1e-12)
    assert "ylabel={angle [rad]}" in text


@pytest.mark.needs("pdflatex")
@pytest.mark.slow
@pytest.mark.parametrize("name", ["closed loop", "arm", "names"])
def test_latex_typesets_the_report_within_the_page(
    equations: Equations, motion: Motion, name: str, tmp_path: Path
) -> None:
    models = {"arm": numbered_arm(4), "names": strange_pendulum()}
    if name in models:
        file = report(models[name], tmp_path / "model.tex", units={g: "µN·m²"})
    else:
        file = report(equations, tmp_path / "model.tex", motion=motion)
    command = ["pdflatex", "-interaction=nonstopmode", "-halt-on-error", file.name]
    done = subprocess.run(
        command, cwd=tmp_path, capture_output=True, text=True, errors="replace", check=False
    )
    assert done.returncode == 0, done.stdout[-2000:]
    wider = [float(points) for points in re.findall(r"Overfull \\hbox \(([\d.]+)pt", done.stdout)]
    assert max(wider, default=0) < 2, "in points of TeX: a letter has 5"
    assert (tmp_path / "model.pdf").stat().st_size > 10_000


def test_markdown_contains_the_pictures(equations: Equations, motion: Motion, tmp_path: Path) -> None:
    text = written(tmp_path, equations, ".md", motion=motion)
    assert text.startswith("# Slider & crank\n\n## Mechanism\n")
    assert f"$$\n{equations.latex()}\n$$" in text
    pictures = re.findall(r"!\[.*\]\(data:image/svg\+xml;base64,(.*)\)", text)
    assert [len(svg_of(b64decode(picture).decode())) for picture in pictures] == [1, 1]
    assert "crank\\_1" in text


def test_tex_stands_alone(equations: Equations, tmp_path: Path) -> None:
    text = written(tmp_path, equations, ".tex")
    assert text.startswith("\\documentclass{article}")
    assert text.endswith("\\end{document}\n")
    assert r"Slider \& crank" in text
    begun, ended = (re.findall(rf"\\{side}\{{(\w+\*?)\}}", text) for side in ("begin", "end"))
    assert sorted(begun) == sorted(ended)
    assert "tikzpicture" in begun


def test_a_notebook_has_one_cell_for_each_section(
    equations: Equations, motion: Motion, tmp_path: Path
) -> None:
    notebook = json.loads(written(tmp_path, equations, ".ipynb", motion=motion))
    assert (notebook["nbformat"], notebook["nbformat_minor"]) == (4, 5)
    assert {cell["cell_type"] for cell in notebook["cells"]} == {"markdown"}
    assert len({cell["id"] for cell in notebook["cells"]}) == len(notebook["cells"]) == 1 + len(SECTIONS)
    attached = [name for cell in notebook["cells"] for name in cell.get("attachments", {})]
    assert attached == ["mechanism.svg", "motion.svg"]
    for cell in notebook["cells"]:
        for name in cell.get("attachments", {}):
            assert f"(attachment:{name})" in "".join(cell["source"])


# --- pictures ---


def test_the_picture_is_one_of_the_reference_position(equations: Equations, tmp_path: Path) -> None:
    first, second = (
        written(tmp_path, equations, ".html", position={phi: angle}, parameters={l: 3})
        for angle in (0.5, 1.0)
    )
    shapes = [ElementTree.tostring(svg_of(text)[0]) for text in (first, second)]
    assert shapes[0] != shapes[1]
    names = {element.text for element in svg_of(first)[0].iter("{http://www.w3.org/2000/svg}text")}
    assert {"x", "y", "ground", "crank_1", "rod <b>", "slider"} <= names


def test_a_model_is_drawn_with_its_numbers(tmp_path: Path) -> None:
    """The page of a model has the picture that these numbers give, and tells them; given ones come first."""
    pendulum = n_pendulum(1)
    text = written(tmp_path, pendulum, ".html")
    own = written(
        tmp_path, pendulum.system, ".html", parameters=pendulum.parameters, position={pendulum["theta1"]: 1.0}
    )
    assert ElementTree.tostring(svg_of(text)[0]) == ElementTree.tostring(svg_of(own)[0])
    assert pendulum.initial[pendulum["theta1"]] == 1.0
    told = f"It is drawn with $\\theta_{{1}} = {{}}${NO_BREAK}rad, $l_{{1}} = 1${NO_BREAK}m."
    text = written(tmp_path, pendulum, ".md")
    assert "at the start of a typical motion, with the numbers of the model." in text
    assert told.replace("{}", "1") in text
    assert told.replace("{}", "0.2") in written(tmp_path, pendulum, ".md", position={pendulum["theta1"]: 0.2})


def test_a_loop_of_a_model_closes_at_a_given_position(tmp_path: Path) -> None:
    """The angles of the model are where the search begins."""
    linkage = four_bar()
    text = written(tmp_path, linkage, ".md", position={linkage["qA"]: 0.8})
    (told,) = re.findall("It is drawn with (.*)", text)
    found = {name: float(value) for name, value in re.findall(r"\{q([ABC])\} = ([\d.]+)", told)}
    assert found["A"] == 0.8
    LA, LB, LC, LN = (linkage.parameters[linkage[name]] for name in ("LA", "LB", "LC", "LN"))
    gaps = [
        LA * turn(found["A"]) + LB * turn(found["B"]) - LC * turn(found["C"]) - offset
        for turn, offset in ((np.cos, 0), (np.sin, LN))
    ]
    np.testing.assert_allclose(gaps, 0, atol=2e-3)


def test_lengths_differ_without_numbers(tmp_path: Path) -> None:
    text = written(tmp_path, numbered_arm(3), ".md")
    assert "were chosen for this picture; masses are 1." in text
    assert f"$d_{{1}} = 1${NO_BREAK}m, $d_{{2}} = 1.2${NO_BREAK}m, $d_{{3}} = 1.1${NO_BREAK}m." in text


def test_the_picture_satisfies_the_constraints(tmp_path: Path) -> None:
    """If no position does, the report says so."""
    x, y = functions_of_time("x y")
    ball = Body(translate(x, y, 0), m1, name="ball")
    impossible = lagrange_equations(System([ball], coordinates=[x, y], constraints=[x**2 + y**2 + l**2]))
    assert "There is no picture, because the reference position was not found." in written(
        tmp_path, impossible, ".md"
    )


# --- large systems ---


def test_a_large_system_is_summarised(tmp_path: Path) -> None:
    large = newton_euler(numbered_arm(30))
    assert cost(large.residuals).total > READABLE
    text = written(tmp_path, large, ".md")
    assert len(text) < 150_000
    assert "They would fill pages: equations.residuals contains them." in text
    assert "too large for checks" in text


def test_equations_of_many_rows_are_described_by_sizes_and_short_entries(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Seven joints on short pages: what can be read is printed, with the values of the mass matrix."""
    monkeypatch.setattr(display, "LINES", 10)
    arm = newton_euler(numbered_arm(7))
    assert cost(arm.residuals).total < READABLE
    document = blocks(arm, equations_of_motion)
    start = document.blocks.index(Heading("Equations of motion"))
    _, sizes, _, matrix, _, entries = document.blocks[start + 1 : start + 7]
    assert isinstance(sizes, Table)
    assert isinstance(matrix, Table)
    assert isinstance(entries, Formula)
    assert [row[0] for row in sizes.rows] == [(Math(latex(q)),) for q in arm.coordinates]
    assert [cell[0] for cell in matrix.rows[6]][7] == str(cost(arm.mass_matrix[6, 6]).total)
    assert f"M_{{66}} &= {latex(readable(arm.mass_matrix[5, 5]))}" in entries.latex
    assert all(block.latex.count(r"\\ ") < ROWS for block in document.blocks if isinstance(block, Formula))


def test_equations_of_seven_joints_are_printed_by_common_quantities() -> None:
    _, _, formula = blocks(newton_euler(numbered_arm(7)), equations_of_motion).blocks
    assert isinstance(formula, Formula)
    assert r"&w\colon \text{angular velocities};\; \alpha\colon \text{angular accelerations}" in formula.latex
    assert r"&n_{1} = 0" in formula.latex


def test_multipliers_of_one_unit_share_a_row_in_the_plural() -> None:
    """lambda2 and lambda3 are those of constraints 2 and 3, by their numbers."""
    found = [
        Entry(symbol, f"multiplier of constraint {k}", "N")
        for k, symbol in enumerate(symbols("lambda1 lambda2"), 1)
    ]
    assert {entry.kind for entry in found} == {"multiplier of constraint #"}
    assert row_meaning(found) == "multipliers of constraints 1 and 2"
    assert row_meaning(found[:1]) == "multiplier of constraint 1"


# --- names of the user ---


STRANGE = "Σ ∑ θ 振 é ế ℓ 𝛼 x₁ ŀ"


def strange_pendulum() -> System:
    """Return a pendulum with names in letters that LaTeX's fonts lack."""
    theta, mass, length = functions_of_time("θ_ä"), *symbols("質量 Σb")
    bob = Body(rotate("Z", theta) * translate(0, -length, 0), mass, name=f"{STRANGE}\nbob")
    push = Torque(ground, 0, 0, symbols("größe"), on=bob, name="M\t\u2028\x00")
    return System(
        [bob], [push], coordinates=[theta], gravity=Vector(ground, 0, -g, 0), name=f"{STRANGE}\n\n2"
    )


@pytest.mark.parametrize("suffix", SUFFIXES)
def test_line_breaks_in_names_are_spaces(tmp_path: Path, suffix: str) -> None:
    text = written(tmp_path, strange_pendulum(), suffix)
    assert not set("\t\x00\u2028") & set(text)
    if suffix == ".tex":
        assert r"ŀ" not in text
        assert r"\title{\ensuremath{\Sigma} \ensuremath{\sum}" in text
        assert " 2}\\date" in text
    else:
        assert f"{STRANGE} 2" in text


def test_letters_that_latex_lacks_are_declared(tmp_path: Path) -> None:
    """Each letter of the file is one of T1's, or has a declaration."""
    text = written(tmp_path, strange_pendulum(), ".tex")
    head, body = text.split(r"\title")
    declared = {chr(int(code, 16)) for code in re.findall(r"\\DeclareUnicodeCharacter\{(\w+)\}", head)}
    assert declared == set("質量振")
    assert {letter for letter in body if ord(letter) > 0x17F} == declared


def test_greek_letters_are_those_of_formulas() -> None:
    for code in range(0x391, 0x3D7):
        letter = chr(code)
        if (
            letter.isalpha()
            and len(unicodedata.normalize("NFD", letter)) == 1
            and "GREEK" in unicodedata.name(letter)
        ):
            typeset = latex(symbols(letter))
            if typeset.startswith("\\"):
                spelled = in_text(letter)
                assert spelled in {rf"\ensuremath{{{typeset}}}", typeset.removeprefix(r"\mathrm{")[:-1]}


# --- mistakes ---

x = functions_of_time("x")
CART = System([Body(translate(x, 0, 0), 1, name="cart")], coordinates=[x], name="cart")
PENDULUM = System(
    [Body(rotate("Z", phi) * translate(0, -l, 0), m1)], coordinates=[phi], gravity=Vector(ground, 0, -g, 0)
)
MISTAKES = {
    "report: model.pdf ends in '.pdf', which is not a format; expected one of .html, .ipynb, .md, .tex": (
        CART,
        "model.pdf",
        {},
    ),
    "report: model ends in '', which is not a format; expected one of .html, .ipynb, .md, .tex": (
        CART,
        "model",
        {},
    ),
    "report: 3 is not a path; expected one, such as 'model.html'": (CART, 3, {}),
    "report: 3 is not a model; expected a system, equations of motion such as newton_euler(system), or a model of "
    "symbody.models": (
        3,
        "model.md",
        {},
    ),
    "report: {'x': 1} for position; expected a dictionary such as {theta: 0.3}": (
        CART,
        "model.md",
        {"position": {"x": 1}},
    ),
    "report, parameters: the value of g: 'a' is a str; expected a number, or a row of numbers": (
        PENDULUM,
        "model.md",
        {"parameters": {g: "a"}},
    ),
    "report, parameters: g is nan; expected a finite number": (
        PENDULUM,
        "model.md",
        {"parameters": {g: float("nan")}},
    ),
    "report, parameters: x is not a parameter of these equations; expected one of g, l, m1": (
        PENDULUM,
        "model.md",
        {"parameters": {x: 1}},
    ),
    "report, position: the value of phi: 1j is a complex; expected a number, or a row of numbers": (
        PENDULUM,
        "model.md",
        {"position": {phi: 1j}},
    ),
    "report, position: beta is not a coordinate of this system; expected one of phi": (
        PENDULUM,
        "model.md",
        {"position": {beta: 1}},
    ),
    "report, units: 5 is an int, for g; expected a text, such as 'N/m'": (
        PENDULUM,
        "model.md",
        {"units": {g: 5}},
    ),
    "report, units: tau is not a variable of this model; expected one of g, l, m1, phi, phi'": (
        PENDULUM,
        "model.md",
        {"units": {tau: "N"}},
    ),
    "report, title: 5 is an int; expected a text, such as 'A pendulum'": (CART, "model.md", {"title": 5}),
    "report: 3 for parameters; expected a dictionary such as {l: 0.5}": (CART, "model.md", {"parameters": 3}),
    "report: 3 is not a motion of System(cart, 1 body, 0 loads, 1 coordinate); expected one, such as "
    "simulate(equations, parameters, initial, t=(0, 1))": (CART, "model.md", {"motion": 3}),
}


@pytest.mark.parametrize("message", MISTAKES)
def test_mistakes(message: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    model, path, options = MISTAKES[message]
    with pytest.raises(SymbodyError) as caught:
        report(model, path, **options)  # type: ignore[arg-type]
    assert str(caught.value) == message
    assert not list(tmp_path.iterdir())


def test_a_value_without_effect_is_noticed(tmp_path: Path) -> None:
    with pytest.warns(ModelNotice, match="report: the parameter tau does not occur in this model") as caught:
        report(PENDULUM, tmp_path / "model.md", parameters={tau: 1})
    assert caught[0].filename == __file__


def test_a_missing_folder_is_made(tmp_path: Path) -> None:
    """As `plot` and `animate` do."""
    assert report(CART, tmp_path / "new" / "folder" / "model.md").is_file()


def test_what_can_not_be_written_leaves_what_was_there(tmp_path: Path) -> None:
    (tmp_path / "model.md").mkdir()
    with pytest.raises(PictureError, match="can't be written"):
        report(CART, tmp_path / "model.md")
    assert [file.name for file in tmp_path.iterdir()] == ["model.md"]


def test_a_failure_leaves_the_previous_report(tmp_path: Path) -> None:
    file = report(CART, tmp_path / "model.md")
    before = file.read_bytes()
    with pytest.raises(ReportError):
        report(CART, file, parameters=3)  # type: ignore[arg-type]
    assert file.read_bytes() == before
    assert [each.name for each in tmp_path.iterdir()] == ["model.md"]


def test_a_long_sum_under_a_root_has_a_name() -> None:
    """A root is not broken, so it would be cut at the edge of the page."""
    at = Point(ground, r, l, 0)
    end = Point(rotate("Y", phi) * rotate("X", beta) * translate(s, 0, 0), m3, m2, l)
    body = Body(end.frame, m1)
    strut = spring(end, at, tau, free_length=r, on=body)
    document = blocks(newton_euler(System([body], [strut], q)))
    formulas = [block for block in document.blocks if isinstance(block, Formula)]
    assert any(r"\sqrt{d_{1}}" in formula.latex and r"d_{1} &= " in formula.latex for formula in formulas)


def test_lualatex_needs_no_encoding(tmp_path: Path) -> None:
    """Without its own encoding, kg m² is not kg mš."""
    text = written(tmp_path, System([Body(translate(s, 0, 0), m1)], [], [s]), ".tex")
    head = text.partition(r"\begin{document}")[0]
    assert re.search(r"\\ifPDFTeX\n[^\\]*\\usepackage\[utf8\]\{inputenc\}\n.*fontenc\}\n\\fi", head)


def test_a_mass_is_that_of_all_bodies_that_have_it() -> None:
    wheels = [Body(translate(s, k, 0), m1, name=f"wheel {k}") for k in range(1, 4)]
    rows = cells(blocks(newton_euler(System(wheels, [], [s]))))
    assert ("m_{1}", "mass of wheel 1, wheel 2 and wheel 3", "kg") in rows


def test_places_of_forces_are_lengths(tmp_path: Path) -> None:
    """As the distances of the axles, which stand in no frame of a body."""
    path = tmp_path / "car.md"
    report(newton_euler(single_track_car().system), path)
    assert "| $a$, $b$ | length | m |" in path.read_text(encoding="utf-8")
