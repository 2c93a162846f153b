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
from symbody.symbolic.expression.latex_layout import aligned, in_pages
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


def high_formula() -> str:
    """Return the highest formula that is one."""
    rows = [rf"x_{{{place}}} &= \frac{{a}}{{b}}" for place in range(100)]
    return next(
        text for n in range(99, 0, -1) if (text := in_pages(aligned(rows[:n]))).startswith(r"\begin{aligned}")
    )


@pytest.mark.needs("pdflatex")
def test_equations_fit_an_article_and_break_across_pages(tmp_path: Path) -> None:
    """What is higher than a page is broken between pages, and what isn't is one formula."""
    small, machines = (
        chain("q1 q2"),
        [chain("q1 q2 q3 q4"), chain("alpha beta gamma delta"), newton_euler(arm("ZYYX"))],
    )
    high = [each.latex() for each in machines]
    assert all(r"\begin{align*}" in each for each in high)
    assert small.latex().startswith(r"\begin{aligned}")
    assert r"\begin{aligned}" in machines[0].display.page.latex()
    formulas = "\n\n".join([rf"\[ {small.latex()} \]", *high, rf"\[ {high_formula()} \]"])
    file = tmp_path / "equations.tex"
    file.write_text(
        r"\documentclass[a4paper,11pt]{article}\usepackage{amsmath}\allowdisplaybreaks\begin{document}"
        f"\n{formulas}\n"
        r"\end{document}"
    )
    command = ["pdflatex", "-interaction=nonstopmode", "-halt-on-error", file.name]
    made = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=True)
    assert not re.findall(r"Overfull.*", made.stdout)
