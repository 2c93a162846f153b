"""The same model gives the same bytes: whatever the hash seed, and whatever was computed before.

Each report is written by a process of its own.
"""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

from symbody import (
    cos,
    cost,
    expand,
    functions_of_time,
    lagrange_equations,
    newton_euler,
    rotate,
    simplify,
    sin,
    symbols,
    translate,
)
from tests.reference.robot import robot
from tests.reference.test_double_pendulum_natural import natural
from tests.symbolic import test_textbook_forms as textbook
from tests.worksheets import test_trifilar_seed as trifilar

ROOT = Path(__file__).parents[1]
OTHER_NAMES_FIRST = (
    "import symbody; symbody.functions_of_time('psi theta2 x theta1'); symbody.symbols('m2 l2 m g');"
)


def report(*, busy: bool) -> None:
    """Print texts, LaTeX and costs of several systems; a busy process does other work first and in between."""
    if busy:
        unrelated_work(9)
    models = [
        textbook.double_pendulum(),
        textbook.heavy_top(),
        textbook.spherical_pendulum(),
        textbook.cart_pole(),
        natural(),
        trifilar.system(),
        robot("gimbal_gyro").system,
    ]
    for k, model in enumerate(models):
        for formalism in (lagrange_equations, newton_euler):
            if model.constraints and formalism is newton_euler:
                continue
            if busy:
                unrelated_work(k)
            equations = formalism(model)
            expressions = [*equations.residuals, *equations.mass_matrix.entries, *equations.baumgarte(3, 1)]
            for expression in expressions:
                print(expression)
                print(expression.latex())
                print(expression.maple())
            print(cost(expressions))
            for expression in equations.mass_matrix.entries:
                print(simplify(expression))
    for text in (repr(models[0]), str(models[1].bodies[0].frame)):
        print(text)


def unrelated_work(k: int) -> None:
    """Fill the graph with what shares names and terms with the models, in another order."""
    x, theta2, theta1, phi = functions_of_time("x theta2 theta1 phi")
    l2, m2, l, m, g = symbols("l2 m2 l m g")
    frame = rotate("Y", theta2) * translate(l2, l, x) * rotate("Z", theta1 - theta2)
    for i, entry in enumerate(frame.matrix.entries):
        str(expand((entry + m2 * sin(phi + k)) ** 2))
        simplify(m2 * l * cos(theta2 - theta1) + entry * g - (i + k) * m)


def written_by_a_process(seed: str, *, busy: bool) -> bytes:
    program = f"from tests.test_determinism import report; report(busy={busy})"
    return subprocess.run(
        [sys.executable, "-c", OTHER_NAMES_FIRST * busy + program],
        cwd=ROOT,
        env=os.environ | {"PYTHONHASHSEED": seed, "PYTHONIOENCODING": "utf-8"},
        capture_output=True,
        check=True,
    ).stdout


@pytest.fixture(scope="module")
def reference() -> bytes:
    text = written_by_a_process("0", busy=False)
    assert len(text.splitlines()) > 300
    return text


@pytest.mark.parametrize(("seed", "busy"), [("1", False), ("12345", False), ("0", True), ("777", True)])
def test_same_model_same_bytes(reference: bytes, seed: str, busy: bool) -> None:
    assert written_by_a_process(seed, busy=busy).splitlines() == reference.splitlines()
