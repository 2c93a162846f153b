"""Each example runs from start to end, in a folder of its own; the pendulum's results are looked at more closely."""

import json
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from matplotlib.image import imread
from matplotlib.mathtext import MathTextParser

import symbody as sb
from examples import trifilar_pendulum as trifilar
from tests.repeated import repeated

TRIFILAR = Path(trifilar.__file__)
EXAMPLES = sorted(TRIFILAR.parent.glob("*.py"))
SHORT = 80
"""Lines of a numbered example at most."""


def run(example: Path, folder: Path) -> str:
    """Run an example and return what it tells its reader."""
    finished = subprocess.run(
        [sys.executable, "-W", "error", example],
        cwd=folder,
        env=os.environ | {"MPLBACKEND": "Agg"},
        capture_output=True,
        text=True,
        check=False,
    )
    assert finished.returncode == 0, finished.stderr
    return finished.stdout


@pytest.mark.parametrize(
    "example", [path for path in EXAMPLES if path != TRIFILAR], ids=lambda path: path.stem
)
def test_example_runs(example: Path, tmp_path: Path) -> None:
    assert run(example, tmp_path).strip()
    assert not list(tmp_path.iterdir()), "only the pendulum's demo writes files"


def test_numbered_examples_are_short_and_in_order() -> None:
    numbered = [example for example in EXAMPLES if example != TRIFILAR]
    assert [int(example.stem[:2]) for example in numbered] == list(range(1, len(numbered) + 1))
    assert all(len(example.read_text(encoding="utf-8").splitlines()) < SHORT for example in numbered)


# --- the trifilar pendulum -------------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def models() -> tuple[trifilar.Model, trifilar.Model]:
    return (
        trifilar.derive("worksheet", trifilar.worksheet_system),
        trifilar.derive("own frame", trifilar.physical_system),
    )


@pytest.fixture(scope="module")
def demo(tmp_path_factory: pytest.TempPathFactory) -> tuple[str, Path]:
    """What the demo prints, and the folder out/ that it writes."""
    folder = tmp_path_factory.mktemp("demo")
    return run(TRIFILAR, folder), folder / "out"


def test_demo_reports_what_it_finds_and_writes_its_files(demo: tuple[str, Path]) -> None:
    printed, out = demo
    for quantity in (
        "0 = xA**2 + yA**2 + (zA - h)**2 - h**2",
        "derived in",
        "all 21 together",
        "largest drift of the energy",
        "largest drift of the constr",
    ):
        assert quantity in printed
    names = {str(path.relative_to(out)) for path in out.parent.rglob("*") if path.is_file()}
    pictures = {"trifilar_motion.html", "trifilar_motion.png", "trifilar_report.html"}
    equations = {"trifilar_equations.tex", "trifilar_equations.txt"}
    fortran = {"fortran/Makefile", "fortran/Trifilar_pendulum.f90", "fortran/Trifilar_pendulum_check.f90"}
    matlab = {name for name in names if name.startswith("matlab/")}
    assert names == pictures | equations | fortran | matlab
    assert {"matlab/+Trifilar_pendulum/right_hand_side.m", "matlab/Trifilar_pendulum_check.m"} <= matlab
    picture = imread(out / "trifilar_motion.png")
    assert picture.std() > 0.05, "the picture is not empty"
    text = (out / "trifilar_equations.txt").read_text(encoding="utf-8")
    assert text.count("\n21, constraint 9\n") == 2


def test_demo_shows_the_pendulum(demo: tuple[str, Path]) -> None:
    """The page has the plate, three threads from the vertices to the anchors above them, and the forces in these."""
    page = (demo[1] / "trifilar_motion.html").read_text(encoding="utf-8")
    scene = json.loads(re.search(r'id="scene">(.*?)</script>', page, re.DOTALL)[1])
    assert [body["parts"][0]["kind"] for body in scene["bodies"]] == ["plate"]
    ends = np.array([[line["from"][:3], line["to"][:3]] for line in scene["lines"]])
    np.testing.assert_allclose(np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1), [1, 1, 1], atol=1e-6)
    half, height = 0.3, 0.3 * np.sqrt(3)
    np.testing.assert_allclose(ends[:, 1], [[0, 0, 1], [height, -half, 1], [height, half, 1]], atol=1e-6)
    pulls = np.array([arrow["vector"][:3] for arrow in scene["arrows"]])
    directions = pulls / np.linalg.norm(pulls, axis=1)[:, None]
    np.testing.assert_allclose(directions, ends[:, 1] - ends[:, 0], atol=1e-5)
    assert [point["name"] for point in scene["points"]].count("A") == 1


@pytest.mark.parametrize("described", [1, *repeated([0])])
def test_latex_compiles(
    described: int, models: tuple[trifilar.Model, trifilar.Model], tmp_path: Path
) -> None:
    """By pdflatex where there is one; elsewhere every line of the plate in its own frame is read by matplotlib."""
    document = trifilar.equations_latex(models)
    if shutil.which("pdflatex"):
        (tmp_path / "equations.tex").write_text(document, encoding="utf-8")
        command = ["pdflatex", "-halt-on-error", "-interaction=nonstopmode", "equations.tex"]
        subprocess.run(command, cwd=tmp_path, check=True, capture_output=True)
    parser = MathTextParser("path")
    aligned = re.findall(r"\\begin\{align\*\}\n(.*?)\n\\end\{align\*\}", document, re.DOTALL)
    assert len(aligned) == 2
    lines = aligned[described].split(" \\\\\n")
    assert sum(line.startswith("0 &= ") for line in lines) == 21
    widest = max(parser.parse(f"${line.replace('&', '')}$", dpi=72).width for line in lines)
    assert widest / 72 * 2.54 < 66, "in cm: the page is 70 wide, with margins of 2"


def test_the_start_satisfies_the_constraints(models: tuple[trifilar.Model, trifilar.Model]) -> None:
    equations = models[1].motion
    motion = trifilar.swing(equations, trifilar.thrown(), 0.1)
    constraints = [*equations.constraints, *sb.time_derivatives(equations.constraints)]
    assert np.abs(motion.evaluate(constraints)[:, 0]).max() < 1e-12
    energy = trifilar.outputs(equations).energies["total energy"]
    assert motion[energy][0] > 1, "it is well away from rest"


def test_only_the_plates_own_frame_gives_inertia_to_every_motion(
    models: tuple[trifilar.Model, trifilar.Model],
) -> None:
    worksheet, physical = (
        trifilar.inertia_of_free_motion(model.motion, trifilar.hanging(side))
        for model, side in zip(models, (+1, -1), strict=True)
    )
    assert [np.linalg.matrix_rank(M, tol=1e-9) for M in (worksheet, physical)] == [2, 3]


@pytest.mark.parametrize(("angle", "push"), [(0.9, 0.15), (0.3, 0.0), (-0.5, 0.3)])
def test_energy_and_constraints_stay(
    models: tuple[trifilar.Model, trifilar.Model], angle: float, push: float
) -> None:
    equations = models[1].motion
    motion, shown = trifilar.swing(equations, trifilar.thrown(angle, push), 1.0), trifilar.outputs(equations)
    energy = motion[shown.energies["total energy"]]
    assert np.ptp(energy) < 1e-10 * energy[0]
    rates = sb.time_derivatives(equations.constraints)
    assert np.abs(motion.evaluate([*equations.constraints, *rates])).max() < 1e-11
    assert motion.evaluate(shown.tension).min() > 0


def test_small_motions_have_the_periods_of_the_textbook(
    models: tuple[trifilar.Model, trifilar.Model],
) -> None:
    """The swing is a pendulum of length h; the torsion has ``omega^2 = m g R^2 / (Jzz h)`` with R = l/sqrt(3)."""
    value = {str(symbol): number for symbol, number in trifilar.PARAMETERS.items()}
    swing = value["g"] / value["h"]
    torsion = value["m"] * value["g"] * value["l"] ** 2 / 3 / (value["Jzz"] * value["h"])
    equations, rest, small = models[1].motion, trifilar.hanging(-1), 1e-5
    for angle, push, square in ((0.0, small, swing), (small, 0.0, torsion)):
        guess = trifilar.thrown(angle, push, velocity=(0, 0, 0))
        motion = trifilar.swing(equations, guess, 0.01)
        state = motion.evaluate(equations.coordinates)[:, 0]
        assert np.abs(state - rest).max() > 0.3 * small
        acceleration = motion.evaluate(equations.accelerations)[:, 0]
        assert acceleration == pytest.approx(-square * (state - rest), abs=1e-3 * square * small)
