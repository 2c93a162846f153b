"""Equations in LaTeX fit the page of an article: pdflatex reports no line that is too wide."""

from __future__ import annotations

import re
import subprocess
from pathlib import Path

import pytest

from symbody import (
    Body,
    Equations,
    System,
    Vector,
    functions_of_time,
    ground,
    newton_euler,
    rotate,
    symbols,
    translate,
)
from tests.page.test_rules import arm


def chain(names: str) -> Equations:
    """Return the equations of point masses on links that hang from each other."""
    frame, bodies = ground, []
    for i, angle in enumerate(functions_of_time(names)):
        l, m = symbols(f"l{i} m{i}")
        frame = frame * rotate("Z", angle) * translate(0, -l, 0)
        bodies.append(Body(frame, m))
    gravity = Vector(ground, 0, -symbols("g"), 0)
    return newton_euler(System(bodies, coordinates=[*functions_of_time(names)], gravity=gravity))


@pytest.mark.needs("pdflatex")
def test_equations_fit_an_article_and_break_across_pages(tmp_path: Path) -> None:
    """`align*` in the place of `aligned` is broken between pages, as the documentation says."""
    machines = [chain("q1 q2"), chain("q1 q2 q3 q4"), chain("alpha beta gamma"), newton_euler(arm("ZYY"))]
    formulas = "\n".join(each.latex().replace("{aligned}", "{align*}") for each in machines)
    file = tmp_path / "equations.tex"
    file.write_text(
        r"\documentclass[a4paper,11pt]{article}\usepackage{amsmath}\allowdisplaybreaks\begin{document}"
        f"\n{formulas}\n"
        r"\end{document}"
    )
    command = ["pdflatex", "-interaction=nonstopmode", "-halt-on-error", file.name]
    made = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=True)
    assert not re.findall(r"Overfull.*", made.stdout)
