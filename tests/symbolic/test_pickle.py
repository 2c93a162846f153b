"""Expressions go to other processes in the form they have, and what they share stays shared."""

from __future__ import annotations

import pickle
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from symbody.codegen import lambdify
from symbody.symbolic import (
    Expr,
    Matrix,
    cost,
    function,
    functions_of_time,
    number,
    pi,
    sin,
    symbols,
    t,
    time_derivative,
)
from tests.repeated import repeated
from tests.symbolic.random_expression import doubling, expression

a = symbols("a")
p = symbols("p", positive=True)
z = symbols("z", real=False)
q = functions_of_time("q")
f = function("f")


@pytest.mark.parametrize(
    "leaf",
    [a, p, z, q, time_derivative(q, 3), t, pi, number(3) / 7, number(0.1), f.derivative([0, 2], a, q)],
    ids=str,
)
def test_leaves_come_back(leaf: Expr) -> None:
    back = pickle.loads(pickle.dumps(leaf))
    assert back.same_form(leaf)
    assert back.is_decimal == leaf.is_decimal


@pytest.mark.parametrize("seed", [*range(60), *repeated(range(60, 200))])
def test_forms_come_back(seed: int) -> None:
    written = expression(seed)
    assert pickle.loads(pickle.dumps(written)).same_form(written)


def test_deep_and_shared_expressions_come_back() -> None:
    deep = doubling(2000)
    assert pickle.loads(pickle.dumps(deep)).same_form(deep)


def test_the_entries_of_a_matrix_share_their_terms() -> None:
    shared = doubling(100)
    matrix = Matrix([[shared, sin(shared)], [shared**2, 1]])
    assert pickle.loads(pickle.dumps(matrix)) == matrix
    assert len(pickle.dumps(matrix)) < 1.5 * len(pickle.dumps(shared))


def test_a_compiled_function_comes_back() -> None:
    compiled = lambdify([a, [p, q]], [Matrix([[a, p]]), [sin(q)]])
    back = pickle.loads(pickle.dumps(compiled))
    for ours, theirs in zip(compiled(1.0, [2.0, 3.0]), back(1.0, [2.0, 3.0]), strict=True):
        np.testing.assert_array_equal(ours, theirs)


def test_another_process_builds_the_same_form(tmp_path: Path) -> None:
    written = Matrix([[expression(seed) for seed in range(20)]])
    file = tmp_path / "matrix.pickle"
    file.write_bytes(pickle.dumps(written))
    program = (
        "import pickle, sys; from pathlib import Path; from symbody import cost;"
        "m = pickle.loads(Path(sys.argv[1]).read_bytes()); print(m, cost(m), sep='\\n')"
    )
    printed = subprocess.run(
        [sys.executable, "-c", program, str(file)], capture_output=True, text=True, check=True
    ).stdout
    assert printed == f"{written}\n{cost(written)}\n"
