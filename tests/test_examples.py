"""Each example runs from start to end, in a folder of its own; the pendulum's results are looked at more closely."""

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

from examples import trifilar_pendulum as trifilar

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
def numbers(models: tuple[trifilar.Model, trifilar.Model]) -> trifilar.Numbers:
    return trifilar.Numbers(models[1], trifilar.VALUES)


def test_demo_tells_what_it_finds_and_writes_whole_files(tmp_path: Path) -> None:
    told = run(TRIFILAR, tmp_path)
    for quantity in (
        "derived in",
        "all 21 together",
        "largest drift of the energy",
        "largest drift of the constr",
    ):
        assert quantity in told
    names = sorted(path.name for path in tmp_path.rglob("*") if path.is_file())
    assert names == ["trifilar_equations.tex", "trifilar_equations.txt", "trifilar_motion.png"]
    picture = imread(tmp_path / "out" / "trifilar_motion.png")
    assert picture.std() > 0.05, "the picture is not empty"
    text = (tmp_path / "out" / "trifilar_equations.txt").read_text(encoding="utf-8")
    assert text.count("\n21, constraint 9\n") == 2


def test_latex_compiles(models: tuple[trifilar.Model, trifilar.Model], tmp_path: Path) -> None:
    """By pdflatex where there is one; elsewhere every line is read by matplotlib."""
    document = trifilar.equations_latex(models)
    if shutil.which("pdflatex"):
        (tmp_path / "equations.tex").write_text(document, encoding="utf-8")
        command = ["pdflatex", "-halt-on-error", "-interaction=nonstopmode", "equations.tex"]
        subprocess.run(command, cwd=tmp_path, check=True, capture_output=True)
    parser = MathTextParser("path")
    aligned = re.findall(r"\\begin\{align\*\}\n(.*?)\n\\end\{align\*\}", document, re.DOTALL)
    lines = [line for block in aligned for line in block.split(" \\\\\n")]
    assert len(aligned) == 2
    assert sum(line.startswith("0 &= ") for line in lines) == 42
    widest = max(parser.parse(f"${line.replace('&', '')}$", dpi=72).width for line in lines)
    assert widest / 72 * 2.54 < 46, "in cm: the page is 50 wide, with margins of 2"


def test_the_start_satisfies_the_constraints(numbers: trifilar.Numbers) -> None:
    q, u = np.split(trifilar.displaced_state(numbers), 2)
    assert np.abs(numbers.phi(q, u)).max() < 1e-12
    assert np.abs(numbers.phi_rate(q, u)).max() < 1e-12
    assert numbers.energy(q, u) > 1, "it is well away from rest"


def test_only_the_plates_own_frame_gives_inertia_to_every_motion(
    models: tuple[trifilar.Model, trifilar.Model], numbers: trifilar.Numbers
) -> None:
    worksheet = trifilar.Numbers(models[0], trifilar.VALUES).inertia_of_free_motion(trifilar.hanging(+1))
    physical = numbers.inertia_of_free_motion(trifilar.hanging(-1))
    assert [np.linalg.matrix_rank(M, tol=1e-9) for M in (worksheet, physical)] == [2, 3]


@pytest.mark.parametrize(("angle", "push"), [(0.9, 0.15), (0.3, 0.0), (-0.5, 0.3)])
def test_energy_and_constraints_stay(numbers: trifilar.Numbers, angle: float, push: float) -> None:
    state = trifilar.displaced_state(numbers, angle, push)
    results = trifilar.evaluate(numbers, trifilar.integrate(numbers, state, 1.0, lambda _: None))
    assert np.abs(results.energy_drift).max() < 1e-11
    assert results.position_error.max() < 1e-12
    assert results.velocity_error.max() < 1e-11
    assert results.tension.min() > 0


def test_small_motions_have_the_periods_of_the_textbook(numbers: trifilar.Numbers) -> None:
    """The swing is a pendulum of length h; the torsion has ``omega^2 = m g R^2 / (Jzz h)`` with R = l/sqrt(3)."""
    value = {str(symbol): number for symbol, number in trifilar.VALUES.items()}
    swing = value["g"] / value["h"]
    torsion = value["m"] * value["g"] * value["l"] ** 2 / 3 / (value["Jzz"] * value["h"])
    rest, small = trifilar.hanging(-1), 1e-5
    for angle, push, square in ((0.0, small, swing), (small, 0.0, torsion)):
        state = trifilar.displaced_state(numbers, angle, push, velocity=(0, 0, 0))[:12]
        acceleration = numbers.unknowns(state, np.zeros(12))[:12]
        assert acceleration == pytest.approx(-square * (state - rest), abs=1e-3 * square * small)
