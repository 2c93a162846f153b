"""Notebooks run without a window: each cell shows what it should, and a report is a notebook that opens."""

from __future__ import annotations

import os
import subprocess
import sys
from base64 import b64decode
from collections.abc import Mapping
from html import unescape
from io import BytesIO
from pathlib import Path
from typing import Any

import nbformat
import pytest
from matplotlib.image import imread
from nbformat.v4 import new_code_cell, new_notebook

from symbody import report
from tests.document.models import engine

MODEL = """
import symbody as sb
from tests.document.models import I1, I2, engine, g, l, m1, m2, m3, numbered_arm, phi, r, s, tau
system = engine()
numbers = {r: 0.1, l: 0.3, m1: 1, m2: 0.5, m3: 0.8, I1: 1e-3, I2: 4e-3, g: 9.81, tau: 0.5}
"""
HTML, LATEX, PNG = "text/html", "text/latex", "image/png"
SHOWN = {
    "system": HTML,
    "system.bodies[0]": LATEX,
    "system.loads[0]": HTML,
    "system.gravity": LATEX,
    "system.bodies[1].frame": LATEX,
    "system.bodies[1].center_of_mass": LATEX,
    "system.constraints[0]": LATEX,
    "equations = sb.newton_euler(system); equations": LATEX,
    "equations.mass_matrix": LATEX,
    "equations.matrix_form()": LATEX,
    "sb.newton_euler(numbered_arm(20))": HTML,
    "sb.cost(equations.residuals)": HTML,
    "sb.equilibrium(equations, numbers | {tau: 0}, guess={phi: -1.5, s: 0.3})": HTML,
    "motion = sb.simulate(equations, numbers, {phi: 1.0}, t=(0, 0.5), guess={s: 0.3}); motion": HTML,
    "motion.plot()": PNG,
    "motion.animate()": HTML,
}
"""What is typed into a cell, and the richest form that it shows."""

HERE = Path(__file__).parents[2]
"""The folder of the package `tests`, for the kernel."""

pytestmark = pytest.mark.slow


def executed(notebook: nbformat.NotebookNode, folder: Path) -> nbformat.NotebookNode:
    """Return a notebook with its outputs; it runs in another process, which a failing cell ends."""
    file = folder / "notebook.ipynb"
    nbformat.write(notebook, file)
    settings = {
        name: str(folder / name) for name in ("JUPYTER_RUNTIME_DIR", "JUPYTER_CONFIG_DIR", "IPYTHONDIR")
    }
    settings["PYTHONPATH"] = os.pathsep.join(filter(None, [str(HERE), os.environ.get("PYTHONPATH")]))
    command = [
        sys.executable,
        "-c",
        "from nbclient.cli import main; main()",
        str(file),
        "--inplace",
        "--timeout=120",
    ]
    run = subprocess.run(command, env=os.environ | settings, capture_output=True, text=True, check=False)
    assert run.returncode == 0, run.stderr
    return nbformat.read(file, as_version=4)


def test_each_cell_has_its_rich_output(tmp_path: Path) -> None:
    cells = [new_code_cell(source) for source in (MODEL, *SHOWN)]
    first, *others = executed(new_notebook(cells=cells), tmp_path).cells
    assert first.outputs == []
    found = {cell.source: output(cell) for cell in others}
    assert {source: sorted({HTML, LATEX, PNG} & {*data}) for source, data in found.items()} == {
        source: [kind] for source, kind in SHOWN.items()
    }
    assert "<svg" in found["system"][HTML]
    assert imread(BytesIO(b64decode(found["motion.plot()"][PNG]))).std() > 0.05
    page = unescape(found["motion.animate()"][HTML].partition('srcdoc="')[2])
    assert page.startswith("<!doctype html>")
    assert found["motion.animate()"]["text/plain"].startswith("Animation(Slider & crank, ")


def output(cell: nbformat.NotebookNode) -> Mapping[str, Any]:
    """Return the forms of the only output of a cell."""
    (shown,) = cell.outputs
    assert shown.output_type == "execute_result", shown
    return dict(shown.data)


def test_a_report_is_a_notebook_that_opens_and_runs(tmp_path: Path) -> None:
    notebook = nbformat.read(report(engine(), tmp_path / "model.ipynb"), as_version=4)
    nbformat.validate(notebook)
    assert [cell.cell_type for cell in executed(notebook, tmp_path).cells] == ["markdown"] * 8
