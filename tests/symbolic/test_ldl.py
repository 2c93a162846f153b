"""Elimination in symmetric matrices: what it solves, in which order, at what cost, and what it refuses."""

from __future__ import annotations

from random import Random

import numpy as np
import pytest

from symbody import Expr, Matrix, cost, derivation, ldl_solve, symbols
from symbody.errors import ExpressionError
from symbody.symbolic import number

a, b, c, d = symbols("a b c d")


def symmetric(n: int, entries: dict[tuple[int, int], Expr]) -> Matrix:
    """Return the matrix with these entries, and zeros elsewhere."""
    return Matrix([[entries.get((min(i, j), max(i, j)), number(0)) for j in range(n)] for i in range(n)])


def random_entries(random: Random, n: int) -> dict[tuple[int, int], Expr]:
    return {
        (i, j): symbols(f"m{i}_{j}") for i in range(n) for j in range(i, n) if i == j or random.random() < 0.5
    }


def tree(parents: list[int]) -> Matrix:
    """Return a matrix with an entry wherever one of two rows is the other's ancestor: a mass matrix of a tree."""
    entries = {}
    for row in range(len(parents)):
        ancestor = row
        while ancestor >= 0:
            entries[min(ancestor, row), max(ancestor, row)] = symbols(f"m{ancestor}_{row}")
            ancestor = parents[ancestor]
    return symmetric(len(parents), entries)


def permuted(matrix: Matrix, order: list[int]) -> Matrix:
    return Matrix([[matrix[i, j] for j in order] for i in order])


@pytest.mark.parametrize("seed", range(10))
def test_the_solution_solves(seed: int) -> None:
    random = Random(seed)
    n = random.randint(1, 6)
    A = symmetric(n, random_entries(random, n))
    right = symbols([f"b{k}" for k in range(n)])
    x = ldl_solve(A, right)
    for i in range(n):
        assert (sum((A[i, j] * x[j] for j in range(n)), start=number(0)) - right[i]).is_zero


def test_columns_are_solved_together() -> None:
    A = Matrix([[a, b], [b, c]])
    assert A @ ldl_solve(A, Matrix([[1, 0], [0, 1]])) == Matrix([[1, 0], [0, 1]])
    assert ldl_solve(A, Matrix.column([a, b])) == Matrix.column([1, 0])


def test_numbers_against_numpy() -> None:
    random = np.random.default_rng(1)
    root = random.integers(-9, 9, (5, 5))
    A, right = root @ root.T + np.eye(5, dtype=int), random.integers(-9, 9, 5)
    x = ldl_solve(Matrix(A.tolist()), right.tolist())
    np.testing.assert_allclose([float(entry) for entry in x], np.linalg.solve(A, right), rtol=1e-12)


def test_a_tree_keeps_its_zeros_in_any_order_of_its_rows() -> None:
    """Elimination of a row of k entries off the diagonal: k multipliers, k (k + 1) / 2 products, and the right side."""
    parents = [-1, 0, 1, 1, 3, 0, 5, 6, 6]
    A = tree(parents)
    n = A.rows
    depths = [sum(not A[row, column].is_zero for column in range(row)) for row in range(n)]
    expected = sum(k + k * (k + 1) // 2 + 2 * k + 1 for k in depths)
    random = Random(0)
    for _ in range(5):
        count = cost(ldl_solve(A, symbols([f"b{k}" for k in range(n)])))
        assert count.multiplications + count.divisions <= expected
        order = random.sample(range(n), n)
        A = permuted(A, order)


def test_a_chain_of_masses_is_linear() -> None:
    """A tridiagonal matrix: the operations are proportional to its size."""

    def operations(n: int) -> int:
        entries = {(k, k): symbols(f"d{k}") for k in range(n)} | {
            (k, k + 1): symbols(f"e{k}") for k in range(n - 1)
        }
        count = cost(ldl_solve(symmetric(n, entries), symbols([f"b{k}" for k in range(n)])))
        return count.multiplications + count.divisions

    assert operations(30) - operations(20) == operations(20) - operations(10)


def test_a_zero_that_is_seen_needs_no_elimination() -> None:
    """(a + b)^2 - a^2 - 2 a b - b^2 beside the diagonal is no entry."""
    hidden = (a + b) ** 2 - a**2 - 2 * a * b - b**2
    with derivation():
        assert ldl_solve(Matrix([[a, hidden], [hidden, b]]), [c, d]) == (c / a, d / b)


def test_another_pivot_is_taken_where_one_is_zero() -> None:
    A = Matrix([[a, b], [b, 0]])
    assert ldl_solve(A, [c, d]) == (d / b, (c - a * d / b) / b)


MISTAKES = [
    (
        lambda: ldl_solve(Matrix([[a, b], [c, d]]), [a, b]),
        (
            "ldl_solve: the entries (2, 1) and (1, 2) differ; expected a symmetric matrix; linear_solve takes any "
            "square one"
        ),
    ),
    (
        lambda: ldl_solve(Matrix([[a, b]]), [a]),
        "ldl_solve: a 1x2 matrix and a right side of 1 row; expected a square matrix and as many rows",
    ),
    (
        lambda: ldl_solve(Matrix([[a, 0, 0], [0, b, b], [0, b, b]]), [a, b, c]),
        (
            "ldl_solve: row 2 of the 3x3 matrix has no pivot: elimination leaves zeros on the diagonal; "
            "expected a positive definite matrix"
        ),
    ),
]


@pytest.mark.parametrize(("mistake", "message"), MISTAKES)
def test_what_it_refuses(mistake: object, message: str) -> None:
    with pytest.raises(ExpressionError) as caught:
        mistake()  # type: ignore[operator]
    assert str(caught.value) == message
