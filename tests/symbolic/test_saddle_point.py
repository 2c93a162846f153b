"""Saddle-point systems: both equations hold, numbers are those of the whole system, and what is refused."""

from __future__ import annotations

from random import Random

import numpy as np
import pytest

from symbody import Expr, Matrix, lambdify, symbols
from symbody.errors import ExpressionError
from symbody.symbolic import free_symbols, number, saddle_point_solve

a, b, c, d = symbols("a b c d")


def saddle_point(seed: int) -> tuple[Matrix, Matrix, list[Expr], list[Expr]]:
    """Return a random system of which half of the entries are zero."""
    random = Random(seed)
    n = random.randint(2, 6)
    m = random.randint(1, n)
    entries = {(i, j): symbols(f"a{i}_{j}") for i in range(n) for j in range(i) if random.random() < 0.5}
    entries |= {(i, i): symbols(f"a{i}_{i}") for i in range(n)}
    A = Matrix([[entries.get((max(i, j), min(i, j)), number(0)) for j in range(n)] for i in range(n)])
    B = Matrix(
        [[symbols(f"b{k}_{i}") if i == k or random.random() < 0.5 else 0 for i in range(n)] for k in range(m)]
    )
    return A, B, list(symbols([f"f{i}" for i in range(n)])), list(symbols([f"c{k}" for k in range(m)]))


@pytest.mark.parametrize("seed", range(10))
def test_the_solution_solves(seed: int) -> None:
    A, B, f, conditions = saddle_point(seed)
    solution = saddle_point_solve(A, B, f, conditions)
    x, y = (Matrix.column(list(part)) for part in (solution.x, solution.y))
    assert A @ x - B.T @ y == Matrix.column(f)
    assert B @ x == Matrix.column(conditions)


@pytest.mark.parametrize("seed", range(10))
def test_numbers_are_those_of_the_whole_system(seed: int) -> None:
    A, B, f, conditions = saddle_point(seed)
    solution = saddle_point_solve(A, B, f, conditions)
    rng = np.random.default_rng(seed)
    leaves = sorted(free_symbols([*A.entries, *B.entries, *f, *conditions]), key=str)
    diagonal = {f"a{i}_{i}" for i in range(6)}
    values = [rng.uniform(5, 6) if str(leaf) in diagonal else rng.normal() for leaf in leaves]
    found, left, gradients, right = lambdify([leaves], [[*solution.x, *solution.y], A, B, [*f, *conditions]])(
        values
    )
    whole = np.block([[left, -gradients.T], [gradients, np.zeros((len(gradients), len(gradients)))]])
    np.testing.assert_allclose(found, np.linalg.solve(whole, right), rtol=1e-9, atol=1e-9)


@pytest.mark.parametrize(
    ("A", "B", "f", "message"),
    [
        (
            Matrix([[a, b], [c, d]]),
            Matrix([[a, b]]),
            [a, b],
            "expected a symmetric A with a row for each column",
        ),
        (Matrix([[a, b], [b, d]]), Matrix([[a]]), [a, b], "A is 2x2, B 1x1, the right side has 2 entries"),
        (Matrix([[a, b], [b, d]]), Matrix([[a, b]]), [a], "the right side has 1 entry"),
        (Matrix([[0, 0], [0, 0]]), Matrix([[a, b]]), [a, b], "matrix has no pivot"),
    ],
)
@pytest.mark.parametrize("method", ["schur_complement", "null_space"])
def test_mistakes(A: Matrix, B: Matrix, f: list[Expr], message: str, method: str) -> None:
    with pytest.raises(ExpressionError, match=message):
        saddle_point_solve(A, B, f, [c], method)


def test_an_unknown_method() -> None:
    with pytest.raises(
        ExpressionError, match="the method 'magic'; expected one of schur_complement, null_space, piv"
    ):
        saddle_point_solve(Matrix([[a]]), Matrix([[b]]), [a], [c], "magic")


def test_rank() -> None:
    assert Matrix([[a, b], [2 * a, 2 * b]]).rank() == 1
    assert Matrix([[a, b], [b, a]]).rank() == 2
    assert Matrix([[0, 0, 0]]).rank() == 0
    assert Matrix([[a * b, a], [b**2, b], [0, 0]]).rank() == 1
