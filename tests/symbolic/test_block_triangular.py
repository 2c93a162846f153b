"""Which unknowns follow from the others: small blocks first, the first unknowns open, and what is refused."""

from __future__ import annotations

import pytest

from symbody import Matrix, symbols
from symbody.errors import ExpressionError
from symbody.symbolic.linear.block_triangular import block_triangular


def pattern(*rows: str) -> Matrix:
    """Return a matrix of different symbols where the rows have a cross."""
    return Matrix(
        [
            [symbols(f"b{i}_{j}") if mark == "x" else 0 for j, mark in enumerate(row)]
            for i, row in enumerate(rows)
        ]
    )


def test_loops_that_share_a_crank() -> None:
    """Andrews' mechanism: the first loop leaves the crank open, the others follow, each by itself."""
    order = block_triangular(pattern("xxx....", "xxx....", "xx.xx..", "xx.xx..", "xx...xx", "xx...xx"))
    assert [block.rows for block in order.blocks] == [(0, 1), (2, 3), (4, 5)]
    assert [block.columns for block in order.blocks] == [(1, 2), (3, 4), (5, 6)]
    assert order.independent == (0,)


def test_unknowns_of_no_equation_are_independent() -> None:
    order = block_triangular(pattern(".xx."))
    assert [block.columns for block in order.blocks] == [(2,)]
    assert order.independent == (0, 1, 3)


def test_unknowns_that_leave_a_singular_block_are_not_the_dependent_ones() -> None:
    a, b = symbols("a b")
    order = block_triangular(Matrix([[b, a, a], [a, b, b]]))
    assert [block.columns for block in order.blocks] == [(0, 2)]
    assert order.independent == (1,)


@pytest.mark.parametrize(
    ("matrix", "message"),
    [
        (
            pattern("xxxxx", "xxxxx", "xxxxx", "xxxxx"),
            "the equations 1, 2, 3, 4 do not form a block of at most 3",
        ),
        (
            pattern("xx.", "xx.", "xx."),
            "the equations 1, 2, 3 do not form a block of at most 3 independent equations",
        ),
        (
            Matrix([[1, 2, 3], [2, 4, 6]]),
            "the equations 1, 2 do not form a block of at most 3 independent equations",
        ),
        (Matrix([[0, 0, 0]]), "the equations 1 do not form a block"),
    ],
)
def test_what_has_no_small_blocks_is_refused(matrix: Matrix, message: str) -> None:
    with pytest.raises(ExpressionError, match=message):
        block_triangular(matrix)
