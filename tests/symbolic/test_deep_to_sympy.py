"""Deep expressions are converted to SymPy, or refused at once."""

from __future__ import annotations

import sys
from time import perf_counter

import pytest
import sympy

from symbody import from_sympy, sin, symbols, to_sympy
from symbody.errors import ExpressionError

DEPTH = 100_000
x, y = symbols("x y")


def test_what_sympy_cannot_hold_is_refused_at_once() -> None:
    deep = x
    for _ in range(DEPTH):
        deep = sin(deep)
    begin = perf_counter()
    with pytest.raises(ExpressionError) as caught:
        to_sympy(deep)
    assert perf_counter() - begin < 30  # a second on a free machine; it took minutes
    assert str(caught.value) == (
        f"to_sympy: the expression is nested 100001 levels deep; SymPy recurses, and Python's limit is "
        f"{sys.getrecursionlimit()} calls; raise it with sys.setrecursionlimit, or convert parts of it"
    )


def test_nested_sums_are_one_sum() -> None:
    names = symbols("a1:2001")
    total = x
    for name in names:
        total = total + name * y
    converted = to_sympy(total)
    assert isinstance(converted, sympy.Add)
    assert len(converted.args) == len(names) + 1
    assert from_sympy(converted) == total


def test_a_shared_sum_stays_a_term_of_each() -> None:
    inner = x + y
    shared = (inner + 1) * sin(inner)
    assert to_sympy(shared) == (to_sympy(x) + to_sympy(y) + 1) * sympy.sin(to_sympy(x) + to_sympy(y))
