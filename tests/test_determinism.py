"""The same model gives the same bytes: whatever the hash seed, and whatever was computed before.

Each report is written by a process of its own.
"""

from __future__ import annotations

import os
import random
import subprocess
import sys
from itertools import pairwise
from pathlib import Path

import pytest

from symbody import (
    Abs,
    Max,
    cos,
    cost,
    expand,
    factor_terms,
    functions_of_time,
    lagrange_equations,
    latex,
    newton_euler,
    readable,
    rotate,
    show,
    simplify,
    sin,
    sqrt,
    symbols,
    time_derivative,
    translate,
)
from symbody.codegen.sources.generate import source
from symbody.symbolic.calculus.rewrite import textbook_form
from tests.reference.robot import robot
from tests.repeated import repeated
from tests.symbolic import test_textbook_forms as textbook
from tests.worksheets import test_trifilar_seed as trifilar

ROOT = Path(__file__).parents[1]
OTHER_NAMES_FIRST = (
    "import symbody; symbody.functions_of_time('psi theta2 x theta1'); symbody.symbols('m2 l2 m g');"
)


def report(*, busy: bool) -> None:
    """Print texts, LaTeX and costs of several systems; a busy process does other work first and in between."""
    from tests.reference.test_double_pendulum_natural import natural  # noqa: PLC0415 - it loads SciPy

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


def forms_of_models(first: int) -> None:
    """Print models whose names were made before, in another order and in other products, in all forms for readers."""
    made = [symbols(name) for name in ("m", "g", "l", "m1", "m2", "l1", "l2", "A", "B", "C", "M", "R")]
    made += functions_of_time("theta theta1 theta2 phi psi x q1 q2 q3")
    random.Random(first).shuffle(made)
    for one, two in pairwise(made):
        str((one + two) ** 2 * sin(two) - time_derivative(one * two))
    models = textbook.double_pendulum, textbook.heavy_top, textbook.spherical_pendulum, textbook.cart_pole
    for equations in (newton_euler(make()) for make in models):
        show(equations)
        for residual in equations.residuals:
            for form in (textbook_form, readable, simplify, factor_terms):
                print(form(residual), latex(form(residual)))
        print(*source(equations.program(), "c").values())


def derivatives_of_lengths(first: int) -> None:
    """Print what depends on whether a length is known to be real. One form of each length is made first."""
    x, y, l1, l2 = symbols("x y l1 l2")
    q = functions_of_time("q")
    for forms in (
        (x**2 - 2 * x * y + 2 * y**2, (x - y) ** 2 + y**2),
        (l1**2 + 2 * l1 * l2 * cos(q) + l2**2, (l1 + l2 * cos(q)) ** 2 + (l2 * sin(q)) ** 2),
    ):
        Abs(sqrt(forms[first]))
        for form in forms:
            length = sqrt(form)
            for function in (Abs(length), Max(length, 0), Abs(length - y), Max(length - y, 0)):
                print(function, [function.diff(variable) for variable in (x, l1, q)])


def written_by_a_process(seed: str, *, busy: bool) -> bytes:
    return printed(
        OTHER_NAMES_FIRST * busy + f"from tests.test_determinism import report; report(busy={busy})", seed
    )


def printed(program: str, seed: str) -> bytes:
    return subprocess.run(
        [sys.executable, "-c", program],
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


def test_the_order_in_which_names_are_made_does_not_show(capsys: pytest.CaptureFixture[str]) -> None:
    """In a process of its own, and in this one."""
    alone = printed("from tests.test_determinism import forms_of_models; forms_of_models(0)", "0").decode()
    forms_of_models(1)
    assert capsys.readouterr().out == alone
    assert len(alone.splitlines()) > 300


def test_which_form_of_a_length_is_met_first_does_not_show() -> None:
    call = "from tests.test_determinism import derivatives_of_lengths; derivatives_of_lengths({})"
    texts = {printed(call.format(first), "0").decode() for first in range(2)}
    assert len(texts) == 1
    assert texts.pop().count("sign") == 12  # in derivatives of moduli of differences, not in those of lengths


@pytest.mark.parametrize(
    ("seed", "busy"), [("777", True), *repeated([("1", False), ("12345", False), ("0", True)])]
)
def test_same_model_same_bytes(reference: bytes, seed: str, busy: bool) -> None:
    assert written_by_a_process(seed, busy=busy).splitlines() == reference.splitlines()
