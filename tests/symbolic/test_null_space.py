"""Saddle-point systems by independent unknowns: the values of the other ways, and where they are accurate."""

from __future__ import annotations

from random import Random

import numpy as np
import pytest

from symbody import Expr, Matrix, lambdify, symbols
from symbody.errors import ExpressionError
from symbody.symbolic import derivation, free_symbols, number, saddle_point_solve
from symbody.symbolic.linear.block_triangular import block_triangular

a, b, c, d = symbols("a b c d")


def saddle_point(seed: int) -> tuple[Matrix, Matrix, list[Expr], list[Expr]]:
    """Return a random system of blocks of one to three conditions, each with one unknown of earlier ones."""
    random = Random(seed)
    sizes = [random.randint(1, 3) for _ in range(random.randint(1, 3))]
    n = sum(sizes) + random.randint(1, 2)
    entries = {(i, j): symbols(f"a{i}_{j}") for i in range(n) for j in range(i) if random.random() < 0.4}
    entries |= {(i, i): symbols(f"a{i}_{i}") for i in range(n)}
    A = Matrix([[entries.get((max(i, j), min(i, j)), number(0)) for j in range(n)] for i in range(n)])
    B: list[list[Expr]] = []
    for size in sizes:
        rows = range(len(B), len(B) + size)
        columns = {*(k + 1 for k in rows), random.randint(0, len(B))}
        B += [[symbols(f"b{k}_{j}") if j in columns else number(0) for j in range(n)] for k in rows]
    f, right = (
        list(symbols([f"{name}{k}" for k in range(count)])) for name, count in (("f", n), ("c", len(B)))
    )
    return A, Matrix(B), f, right


@pytest.mark.parametrize("seed", range(12))
def test_the_solution_solves(seed: int) -> None:
    A, B, f, right = saddle_point(seed)
    solution = saddle_point_solve(A, B, f, right, "null_space")
    x, y = (Matrix.column(list(part)) for part in (solution.x, solution.y))
    assert A @ x - B.T @ y == Matrix.column(f)
    assert B @ x == Matrix.column(right)


@pytest.mark.parametrize("seed", range(12))
def test_numbers_are_accurate_where_the_conditions_are_positive(seed: int) -> None:
    """Of random systems, and of those near to where the block of the dependent unknowns is singular."""
    A, B, f, right = saddle_point(seed)
    with derivation(fresh=True):
        solution = saddle_point_solve(A, B, f, right, "null_space")
    leaves = sorted(free_symbols([*A.entries, *B.entries, *f, *right]), key=str)
    function = lambdify([leaves], [[*solution.x, *solution.y], list(solution.conditions), A, B, [*f, *right]])
    order = block_triangular(B)
    pivots = {B[row, column] for block in order.blocks for row in block.rows for column in block.columns}
    rng = np.random.default_rng(seed)
    diagonal = {f"a{i}_{i}" for i in range(12)}
    seen = {True: 0, False: 0}
    for trial in range(300):
        values = [rng.uniform(5, 6) if str(leaf) in diagonal else rng.normal() for leaf in leaves]
        near = 10.0 ** rng.uniform(-9, -1) if trial % 2 else 1.0
        values = [
            near * value if leaf in pivots else value for leaf, value in zip(leaves, values, strict=True)
        ]
        found, conditions, left, gradients, sides = function(values)
        is_accurate = bool(np.all(np.array(conditions) > 0))
        seen[is_accurate] += 1
        if is_accurate:
            m = len(gradients)
            whole = np.block([[left, -gradients.T], [gradients, np.zeros((m, m))]])
            n, residual = len(left), whole @ found - sides
            size = np.abs(whole) @ np.abs(found) + np.abs(sides)
            assert np.all(np.abs(residual[n:]) <= 1e-11 * size[n:])
            assert np.all(np.abs(residual[:n]) <= 1e-9 * size[:n].max())
    assert seen[True] > 10
    is_coupled = any(not B[row, j].is_zero for row in range(B.rows) for j in order.independent)
    assert (seen[False] > 10) == is_coupled


def test_nothing_is_open() -> None:
    """As many conditions as unknowns: x follows from them alone."""
    solution = saddle_point_solve(
        Matrix([[a, 0], [0, b]]), Matrix([[c, 0], [0, d]]), [0, 0], [1, 1], "null_space"
    )
    assert solution.x == (1 / c, 1 / d)
    assert solution.y == (a / c**2, b / d**2)
    assert [str(condition) for condition in solution.conditions] == ["0.999*Abs(c)", "0.999*Abs(d)"]


@pytest.mark.parametrize(("angle", "is_accurate"), [(0.1, True), (1e-4, False), (0.0, False)])
def test_equations_that_are_nearly_parallel(angle: float, is_accurate: bool) -> None:
    """Of a block that no independent unknown stands in, cancellation in the determinant is all that tells."""
    B = Matrix([[0, a, b], [0, c, d]])
    solution = saddle_point_solve(
        Matrix([[1, 0, 0], [0, 1, 0], [0, 0, 1]]), B, [0, 0, 0], [1, 1], "null_space"
    )
    conditions = lambdify([a, b, c, d], list(solution.conditions))(1.0, 1.0, 1.0, 1.0 + angle)
    assert bool(np.all(np.array(conditions) > 0)) == is_accurate


def test_values_are_those_of_the_other_ways() -> None:
    system = saddle_point(3)
    with derivation(fresh=True):
        solution, *others = [
            saddle_point_solve(*system, method) for method in ("null_space", "schur_complement", "pivoted")
        ]
    for other in others:
        assert (solution.x, solution.y, ()) == (other.x, other.y, other.conditions)


def test_conditions_that_follow_from_others() -> None:
    with pytest.raises(ExpressionError, match="the equations 1 do not form a block"):
        saddle_point_solve(Matrix([[a, b], [b, d]]), Matrix([[0, 0]]), [a, b], [c], "null_space")
