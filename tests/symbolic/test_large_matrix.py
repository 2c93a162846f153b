"""Large matrices are made, transposed, added and multiplied in time near that of writing their entries."""

from __future__ import annotations

from collections.abc import Callable
from time import perf_counter

import numpy as np
import pytest

from symbody import Matrix, identity, symbols, zeros
from symbody.errors import ArgumentError
from symbody.symbolic import number

SIZE = 1000
x = symbols("x")
large = identity(SIZE)


@pytest.mark.parametrize(
    "make",
    [
        lambda: identity(SIZE),
        lambda: zeros(SIZE, SIZE),
        lambda: Matrix([[0] * SIZE] * SIZE),
        lambda: Matrix(np.zeros((SIZE, SIZE))),
        lambda: large.T,
        lambda: large + large,
        lambda: x * large,
        lambda: large @ large,
    ],
)
def test_a_million_entries_take_no_seconds(make: Callable[[], Matrix]) -> None:
    """They took seconds, four microseconds for each entry; a product of sparse ones 10**9 steps."""
    begin = perf_counter()
    assert make().shape == (SIZE, SIZE)
    assert perf_counter() - begin < 3


def test_they_are_what_they_were() -> None:
    a = Matrix([[1, x, 0.5], [0, 2, np.float64(0.5)]])
    assert a.entries == (number(1), x, number(0.5), number(0), number(2), number(0.5))
    assert Matrix([[1, 0], [x, 2], [0.5, 0.5]]) == a.T
    assert a == a.T.T
    assert a + a == 2 * a
    assert -a == a * -1
    assert a - a == zeros(2, 3)
    assert a / 2 == Matrix([[0.5, x / 2, 0.25], [0, 1, 0.25]])
    assert a == a @ identity(3)
    assert (a @ a.T)[0, 0] == 1 + x**2 + number(0.25)
    assert identity(0).shape == (0, 0)
    assert zeros(0, 3).T.shape == (3, 0)
    assert identity(1).entries == (number(1),)
    assert Matrix([[1.0, 1]])[0, 0].is_decimal


def test_a_wrong_entry_has_its_place() -> None:
    for wrong in ("1", None, True, float("nan")):
        with pytest.raises(ValueError, match=r"Matrix, row 2, column 1|not a finite number"):
            Matrix([[1, 2], [wrong, 2]])
    with pytest.raises(ArgumentError, match="Matrix, row 1, column 2"):
        Matrix([[1, True]])
